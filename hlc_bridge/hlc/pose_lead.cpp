#include "hlc_bridge/hlc/pose_lead.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/controller/drift.hpp"

namespace hlc::high_level_controller {
namespace {

double median(const std::deque<double>& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

/// e of the header; none if the vehicle is not seen, or was not to drive.
std::optional<double> time_ahead_s(const controller::Controller& controller,
                                   const controller::Observation& observation) {
  const coordination::MeasuredVehicle* own = observation.measured(controller.options().vehicle);
  if (own == nullptr || !controller.has_plan()) return std::nullopt;
  const automaton::UniversalAutomaton& automaton = controller.subgraph().automaton();
  const controller::SeenAt seen = controller::seen_at(*own, observation.step, automaton.step_s);
  const coordination::Plan& plan = controller.plan_in_force();
  if (seen.step < plan.first()) return std::nullopt;
  const TimedPoint planned = vehicle::timed_point(
      seen.time_s, plan.state_at(seen.step, seen.time_s, automaton.vehicle), automaton.vehicle);
  const Point velocity = planned.velocity_mps;
  if (velocity.norm() < PoseLeadCheck::kLeastSpeed_mps) return std::nullopt;
  return velocity.dot(seen.pose.position_m() - planned.position_m) / velocity.squaredNorm();
}

}  // namespace

std::optional<std::string> PoseLeadCheck::note(const controller::Controller& controller,
                                               const controller::Observation& observation) {
  const std::optional<double> ahead =
      is_logged_ ? std::nullopt : time_ahead_s(controller, observation);
  if (!ahead) return std::nullopt;
  times_ahead_s_.push_back(*ahead);
  if (times_ahead_s_.size() > kMostSteps) times_ahead_s_.pop_front();
  if (times_ahead_s_.size() < kLeastSteps) return std::nullopt;
  const double error_s = median(times_ahead_s_);
  if (std::abs(error_s) <= kTolerance_s) return std::nullopt;
  is_logged_ = true;
  const double set_s = vehicle::pose_lead_s(controller.options().lab);
  const double lead_s = set_s + error_s;
  const std::string line = fmt::format(
      "poses lie about {:.0f} ms ahead of their stamps (median of {} steps), pose_lead_s of the "
      "lab's description is {:.3f}: ",
      1e3 * lead_s, times_ahead_s_.size(), set_s);
  if (lead_s < 0.0 || lead_s > vehicle::kMostPoseLead_s) {
    return line + "the vehicle does not keep to its plans in time, or its clock is wrong";
  }
  if (!controller.options().lab) return line + "the scenario names no lab (key lab)";
  return line + fmt::format("set it to {:.3f}, if the other vehicles show the same", lead_s);
}

}  // namespace hlc::high_level_controller
