#include "planner/coordination/planning_input.hpp"

#include <algorithm>
#include <array>

#include "planner/geometry/pose.hpp"

namespace hlc::coordination {
namespace {

/// Vehicles are seen within a step.
constexpr double kLongestStep_s = 10.0;

/// Longer plans than that are no plans of a controller.
constexpr std::size_t kMostPoses = 256;

/// Not a number compares false.
bool is_within(double value, double least, double most) { return value >= least && value <= most; }

bool is_sane(const Pose& pose) {
  const auto is_coordinate = [](double value) {
    return is_within(value, -kLargestCoordinate_m, kLargestCoordinate_m);
  };
  return is_coordinate(pose.x_m) && is_coordinate(pose.y_m) &&
         is_within(pose.heading_rad, -kLargestCoordinate_m, kLargestCoordinate_m);
}

bool is_sane(const DrivableAreaState::Widened& widened) {
  const std::array numbers{widened.from_s_m, widened.to_s_m, widened.left_m, widened.right_m};
  return std::ranges::all_of(numbers,
                             [](double number) {
                               return is_within(number, -kLargestCoordinate_m,
                                                kLargestCoordinate_m);
                             }) &&
         widened.from_s_m <= widened.to_s_m && widened.left_m >= 0.0 && widened.right_m >= 0.0;
}

bool is_sane(const PlanByIndex& plan, StepIndex step) {
  return plan.first.value + 1 >= step.value && plan.first <= step &&
         plan.poses.size() == plan.maneuvers.size() + 1 && plan.poses.size() <= kMostPoses &&
         std::ranges::all_of(plan.poses, [](const Pose& pose) { return is_sane(pose); });
}

}  // namespace

bool is_well_formed(const PlanningInput& input, StepIndex step) {
  return is_sane(input.base, step) && input.seen_step >= input.base.first &&
         input.seen_step <= step && is_within(input.seen_time_s, 0.0, kLongestStep_s) &&
         is_sane(input.seen_pose) && is_within(input.deviation_m, 0.0, kLargestCoordinate_m) &&
         is_within(input.path_s_m, 0.0, kLargestCoordinate_m) &&
         (!input.area.entry || is_sane(*input.area.entry)) &&
         (!input.area.stands_since || input.area.stands_since->value <= step.value + 1);
}

}  // namespace hlc::coordination
