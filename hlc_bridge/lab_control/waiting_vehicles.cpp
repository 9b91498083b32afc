#include "hlc_bridge/lab_control/waiting_vehicles.hpp"

#include <utility>

namespace hlc::lab_control {

WaitingVehicles::WaitingVehicles(Nanoseconds period)
    : step_s_(1e-9 * static_cast<double>(period)) {}

void WaitingVehicles::add(const coordination::Report& report) {
  Reported& vehicle = vehicles_[report.vehicle];
  vehicle.last = report;
  if (auto line = vehicle.notice.note(report, step_s_)) notices_.push_back(*std::move(line));
}

std::vector<std::string> WaitingVehicles::take_notices() { return std::exchange(notices_, {}); }

std::string WaitingVehicles::stuck_line() const {
  std::string line;
  for (const auto& [id, vehicle] : vehicles_) {
    if (!coordination::is_stuck(vehicle.last, step_s_)) continue;
    line += (line.empty() ? "stuck at the end: " : "; ") +
            coordination::waiting_text(vehicle.last, step_s_);
  }
  return line;
}

}  // namespace hlc::lab_control
