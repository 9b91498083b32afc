#include "hlc_bridge/view/live_messages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hlc_bridge/view/page_parts.hpp"

namespace hlc::view {
namespace {

/// States kept while no car drives yet.
constexpr std::size_t kStatesBefore = 64;

/// Moved to multiples of the vehicle's period, of equal times the first, from `begin` on.
std::vector<result::DrivenSample> on_grid(const std::vector<result::DrivenSample>& samples,
                                          Nanoseconds begin) {
  std::vector<result::DrivenSample> moved;
  for (result::DrivenSample sample : samples) {
    const Nanoseconds rounded = sample.t + kVehiclePeriod / 2;
    if (rounded < begin) continue;
    sample.t = begin + (rounded - begin) / kVehiclePeriod * kVehiclePeriod;
    if (moved.empty() || sample.t > moved.back().t) moved.push_back(sample);
  }
  return moved;
}

}  // namespace

LiveMessages::LiveMessages(FinishedRun run) : run_(std::move(run)), steps_(run_.description) {
  for (const std::uint8_t id : run_.facts.vehicle_ids) vehicles_[id];
}

void LiveMessages::take(const ReportRecord& record) {
  const auto found = vehicles_.find(record.report.vehicle.value);
  if (found == vehicles_.end()) return;
  Vehicle& vehicle = found->second;
  const std::uint64_t step = record.report.step.value;
  const bool is_known = vehicle.last_step && step <= *vehicle.last_step;
  const bool is_standby = record.report.status == coordination::StepStatus::kStandby;
  const bool has_driven = vehicle.last_step.has_value();
  const bool is_before = run_.facts.first_step && step < *run_.facts.first_step;
  if (is_known || is_before || (is_standby && !has_driven)) return;
  vehicle.last_step = step;
  vehicle.rows.push_back({.step = step, .record = record, .driven = {}});
}

void LiveMessages::take(const VehicleState& state) {
  const auto found = vehicles_.find(state.vehicle_id);
  if (found == vehicles_.end()) return;
  std::vector<result::DrivenSample>& samples = found->second.samples;
  if (!run_.facts.first_step && samples.size() >= kStatesBefore) samples.erase(samples.begin());
  samples.push_back({.t = state.create_stamp, .pose = state.pose, .speed_mps = state.speed_mps});
}

void LiveMessages::take(std::vector<result::LoggedLine> lines) {
  std::ranges::move(lines, std::back_inserter(run_.log));
}

bool LiveMessages::has_begun() {
  if (run_.facts.first_step) return true;
  std::optional<std::uint64_t> first;
  bool have_all = true;
  for (const auto& [id, vehicle] : vehicles_) {
    have_all = have_all && !vehicle.rows.empty();
    if (vehicle.rows.empty()) continue;
    first = std::min(first.value_or(vehicle.rows.front().step), vehicle.rows.front().step);
  }
  if (!first || (!have_all && ++portions_waited_ <= kPatience)) return false;
  run_.facts.first_step = first;
  return true;
}

std::string LiveMessages::portion() {
  const Json messages = new_messages();
  return messages.empty() ? std::string{} : text_of(messages);
}

std::string LiveMessages::last_portion(const std::string& reason) {
  portions_waited_ = kPatience;
  Json messages = new_messages();
  messages.push_back({{"kind", "end"}, {"reason", reason}});
  return text_of(messages);
}

Json LiveMessages::new_messages() {
  Json messages = Json::array();
  if (!std::exchange(has_sent_run_, true)) messages.push_back(run_message(run_));
  if (!run_.log.empty()) messages.push_back(log_message(std::exchange(run_.log, {})));
  if (!has_begun()) return messages;
  Json steps = Json::array();
  for (auto& [id, vehicle] : vehicles_) {
    if (vehicle.rows.empty()) continue;
    std::vector<const result::StepRecord*> rows;
    for (result::StepRecord& row : vehicle.rows) {
      row.step = row.record.report.step.value - *run_.facts.first_step;
      rows.push_back(&row);
    }
    steps.push_back(steps_.of(VehicleId{id}, rows));
    vehicle.rows.clear();
  }
  if (Json maneuvers = steps_.new_maneuvers(); !maneuvers.at("maneuvers").empty()) {
    messages.push_back(std::move(maneuvers));
  }
  for (Json& message : steps) messages.push_back(std::move(message));
  for (auto& [id, vehicle] : vehicles_) add_drives(id, vehicle, messages);
  return messages;
}

void LiveMessages::add_drives(std::uint8_t id, Vehicle& vehicle, Json& messages) const {
  const Nanoseconds begin = *run_.facts.first_step * run_.facts.period;
  const std::vector<result::DrivenSample> samples = on_grid(vehicle.samples, begin);
  vehicle.samples.clear();
  if (samples.empty()) return;
  vehicle.samples.push_back(samples.back());
  const bool first_is_sent = std::exchange(vehicle.has_sent_states, true);
  const auto apart = [&](std::size_t i) { return samples[i + 1].t - samples[i].t; };
  const auto is_connected = [&](std::size_t i) {
    return i + 1 < samples.size() && apart(i) <= run_.facts.period;
  };
  for (std::size_t first = 0; first < samples.size();) {
    std::size_t last = first;
    while (is_connected(last) && apart(last) == apart(first)) ++last;
    const bool is_single = first == last;
    if (!is_single || first > 0 || !first_is_sent) {
      messages.push_back(drive_message(id, std::span(samples).subspan(first, last - first + 1),
                                       begin, is_single ? kVehiclePeriod : apart(first)));
    }
    first = !is_single && is_connected(last) ? last : last + 1;
  }
}

}  // namespace hlc::view
