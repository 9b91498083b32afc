#include "planner/coordination/waiting.hpp"

#include <fmt/format.h>

#include "planner/coordination/report.hpp"

namespace hlc::coordination {
namespace {

/// Of the product of a number of steps and their duration.
constexpr double kRounding_s = 1e-6;
constexpr double kMoved_m = 0.01;

}  // namespace

double wait_s(const Report& report, double step_s) {
  if (report.waiting.vehicles.empty()) return 0.0;
  return step_s * static_cast<double>(report.step.value + 1 - report.waiting.since.value);
}

bool is_stuck(const Report& report, double step_s) {
  return wait_s(report, step_s) >= kStuckAfter_s - kRounding_s;
}

std::string waiting_text(const Report& report, double step_s) {
  std::string vehicles;
  for (const VehicleId id : report.waiting.vehicles) {
    vehicles += fmt::format("{}{}", vehicles.empty() ? "" : ", ", id.value);
  }
  return fmt::format("vehicle {}, waiting for {} for {:.1f} s", report.vehicle.value, vehicles,
                     wait_s(report, step_s));
}

std::optional<std::string> StuckNotice::note(const Report& report, double step_s) {
  if (!start_) start_ = report.planned_pose;
  has_moved_ |= (report.planned_pose.position_m() - start_->position_m()).norm() > kMoved_m;
  const bool was_stuck = is_stuck_;
  is_stuck_ = is_stuck(report, step_s);
  if (!is_stuck_ || was_stuck) return std::nullopt;
  return "stuck: " + waiting_text(report, step_s) +
         ", although its road would be free without the others" +
         (has_moved_ ? ""
                     : "; it has not moved since its controller began: if that was at the start of "
                       "the run, place the vehicles elsewhere");
}

}  // namespace hlc::coordination
