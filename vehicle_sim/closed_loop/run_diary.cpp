#include "vehicle_sim/closed_loop/run_diary.hpp"

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::closed_loop {

void DiaryWriter::on_log(NodeId node, const machine::LogLine& line) {
  if (diary_)
    diary_->lines.push_back({.at = lab_->now(), .process = lab_->name(node), .line = line});
  next_->on_log(node, line);
}

void DiaryWriter::on_driven(std::uint8_t vehicle, Nanoseconds time,
                            const result::DrivenSample& sample) {
  if (diary_) {
    diary_->drives[vehicle].push_back(
        {.at = lab_->now(), .time = time, .speed_mps = sample.speed_mps});
  }
  next_->on_driven(vehicle, time, sample);
}

void DiaryWriter::on_report(const ReportRecord& record, const coordination::Plan* in_force) {
  if (diary_) {
    diary_->steps.push_back({.at = lab_->now(), .report = record.report});
    const bool is_planned = record.report.status == coordination::StepStatus::kPlanned;
    if (is_planned && !diary_->begin_of_drive) diary_->begin_of_drive = lab_->now();
  }
  next_->on_report(record, in_force);
}

void DiaryWriter::on_stop_symbol(std::uint8_t vehicle) {
  if (diary_ && !diary_->stop) diary_->stop = lab_->now();
  next_->on_stop_symbol(vehicle);
}

void DiaryWriter::on_progress(const std::string& text) {
  if (diary_) {
    diary_->progress.push_back(
        {.at = lab_->now(), .process = kLabControlName, .line = machine::info(text)});
  }
  next_->on_progress(text);
}

void DiaryWriter::changed(const ProcessSlot& slot) {
  if (!diary_) return;
  const auto [life, is_new] = diary_->lives.try_emplace(slot.name);
  if (is_new) life->second.begin = lab_->now();
  life->second.exit_code = slot.exit_code;
  life->second.end = slot.exit_code ? std::optional(lab_->now()) : std::nullopt;
}

}  // namespace hlc::closed_loop
