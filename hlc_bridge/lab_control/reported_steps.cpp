#include "hlc_bridge/lab_control/reported_steps.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hlc::lab_control {

ReportedSteps::ReportedSteps(std::vector<std::uint8_t> vehicle_ids)
    : vehicle_ids_(std::move(vehicle_ids)) {}

bool ReportedSteps::add(const ReportRecord& record) {
  const std::uint8_t id = record.report.vehicle.value;
  if (std::ranges::find(vehicle_ids_, id) == vehicle_ids_.end()) return false;
  const std::uint64_t step = record.report.step.value;
  std::uint64_t& last = last_.try_emplace(id, step).first->second;
  last = std::max(last, step);
  just_received_.insert(id);
  if (record.report.status != coordination::StepStatus::kStandby) {
    driving_.insert(id);
    first_step_ = std::min(first_step_.value_or(step), step);
  }
  return true;
}

void ReportedSteps::stamp(Nanoseconds now) {
  for (const std::uint8_t id : std::exchange(just_received_, {})) last_received_[id] = now;
}

std::optional<std::uint64_t> ReportedSteps::last(std::uint8_t vehicle_id) const {
  const auto found = last_.find(vehicle_id);
  return found == last_.end() ? std::nullopt : std::optional{found->second};
}

Nanoseconds ReportedSteps::last_received(std::uint8_t vehicle_id) const {
  const auto found = last_received_.find(vehicle_id);
  return found == last_received_.end() ? 0 : found->second;
}

std::vector<std::uint8_t> ReportedSteps::on_standby() const {
  std::vector<std::uint8_t> ids;
  std::ranges::copy_if(vehicle_ids_, std::back_inserter(ids),
                       [this](std::uint8_t id) { return !has_left_standby(id); });
  return ids;
}

}  // namespace hlc::lab_control
