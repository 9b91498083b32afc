#include "hlc_bridge/lab_control/standing_vehicles.hpp"

#include <utility>

namespace hlc::lab_control {

StandingVehicles::StandingVehicles(Nanoseconds period)
    : step_s_(1e-9 * static_cast<double>(period)) {}

void StandingVehicles::add(const coordination::Report& report, StepIndex start) {
  Reported& vehicle = vehicles_[report.vehicle];
  vehicle.last = report;
  if (auto line = vehicle.stuck.note(report, step_s_)) stuck_.push_back(*std::move(line));
  if (auto line = vehicle.arrival.note(report, start, step_s_)) {
    arrived_.push_back(*std::move(line));
  }
}

std::vector<std::string> StandingVehicles::take_stuck() { return std::exchange(stuck_, {}); }

std::vector<std::string> StandingVehicles::take_arrived() { return std::exchange(arrived_, {}); }

std::string StandingVehicles::stuck_line() const {
  std::string line;
  for (const auto& [id, vehicle] : vehicles_) {
    if (!coordination::is_stuck(vehicle.last, step_s_)) continue;
    line += (line.empty() ? "stuck at the end: " : "; ") +
            coordination::waiting_text(vehicle.last, step_s_);
  }
  return line;
}

}  // namespace hlc::lab_control
