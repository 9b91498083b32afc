#include "hlc_bridge/lab_control/real_time_run.hpp"

#include <algorithm>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {

void RealTimeRun::ready(const ReadyStatus& status) {
  const std::vector<std::string> ready = single_ready_ids(status.source_id);
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (std::ranges::count(ready, middleware_ready_id(id)) > 0) ready_.insert(middleware_name(id));
  }
}

void RealTimeRun::state(const VehicleState& state) {
  if (state.vehicle_id != 0) {
    settled_[state.vehicle_id].add(state);
  }
}

std::vector<std::string> RealTimeRun::not_ready() const {
  std::vector<std::string> lines;
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (ready_.count(middleware_name(id)) == 0) {
      lines.push_back(middleware_name(id));
    }
    if (!has_settled(id)) lines.push_back(vehicle_name(id));
  }
  for (const std::uint8_t id : settings().guest_ids) {
    if (!has_settled(id)) lines.push_back(vehicle_name(id));
  }
  return lines;
}

bool RealTimeRun::has_settled(std::uint8_t vehicle_id) const {
  const auto vehicle = settled_.find(vehicle_id);
  return vehicle != settled_.end() && vehicle->second.have_settled();
}

void RealTimeRun::go_on(LabRunActions& actions) {
  if (!start_) {
    start_ = now() + kStartDelay;
    actions.triggers.push_back(*start_);
  }
}

void RealTimeRun::drop(const std::string& process) {
  ready_.erase(process);
  for (const std::uint8_t id : settings().guest_ids) {
    if (process == vehicle_name(id)) settled_.erase(id);
  }
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (process == vehicle_name(id)) {
      settled_.erase(id);
      if (phase() != Phase::kGathering) returns_[id] = kNever;
    }
    const bool ends_reports = process == controller_name(id) || process == middleware_name(id);
    if (ends_reports && phase() != Phase::kGathering) {
      silenced_.insert(id);
    }
  }
}

void RealTimeRun::on_return(const std::string& process) {
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (process == controller_name(id)) {
      silenced_.erase(id);
    }
    if (process == vehicle_name(id)) returns_[id] = now();
  }
}

Nanoseconds RealTimeRun::report_due(std::uint8_t vehicle_id) const {
  if (!start_ || silenced_.count(vehicle_id) != 0) {
    return kNever;
  }
  return std::max(*start_, reports().last_received(vehicle_id)) + kReportTimeout;
}

Nanoseconds RealTimeRun::drive_due(std::uint8_t vehicle_id) const {
  return silenced_.contains(vehicle_id) ? kNever : must_drive_by(vehicle_id);
}

Nanoseconds RealTimeRun::must_drive_by(std::uint8_t vehicle_id) const {
  if (!start_ || !reports().first_step() || reports().has_left_standby(vehicle_id)) return kNever;
  const auto found = returns_.find(vehicle_id);
  const Nanoseconds vehicle_since = found == returns_.end() ? 0 : found->second;
  if (vehicle_since == kNever) return kNever;
  const Nanoseconds others_drive = *reports().first_step() * settings().period;
  return std::max({*start_, others_drive, vehicle_since}) + kReportTimeout;
}

std::vector<Death> RealTimeRun::overdue() const {
  std::vector<Death> deaths;
  for (const std::uint8_t id : settings().vehicle_ids) {
    if (now() >= report_due(id)) {
      deaths.push_back({controller_name(id), "report overdue"});
    } else if (now() >= drive_due(id)) {
      deaths.push_back({controller_name(id), "on standby while others drive"});
    }
  }
  return deaths;
}

Nanoseconds RealTimeRun::next_overdue() const {
  Nanoseconds time = kNever;
  for (const std::uint8_t id : settings().vehicle_ids) {
    time = std::min({time, report_due(id), drive_due(id)});
  }
  return time;
}

}  // namespace hlc::lab_control
