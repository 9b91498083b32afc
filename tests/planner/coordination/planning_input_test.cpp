#include "planner/coordination/planning_input.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "planner/coordination/digest.hpp"

namespace hlc::coordination {
namespace {

constexpr StepIndex kNow{10};

PlanningInput good() {
  PlanningInput input{.basis = 5,
                      .may_plan = true,
                      .base = {.first = {9}, .poses = {{}, {0.1, 0.0, 0.0}}, .maneuvers = {3}},
                      .seen_step = {10},
                      .seen_time_s = 0.05,
                      .deviation_m = 0.002,
                      .path_s_m = 4.0};
  input.area.entry = {.from_s_m = 3.0, .to_s_m = 4.0, .left_m = 0.1, .right_m = 0.0};
  input.area.stands_since = {8};
  return input;
}

// Each of these is one change of the good one.
const std::vector<std::function<void(PlanningInput&)>> kNonsense{
    [](PlanningInput& input) { input.base.first = {12}; },
    [](PlanningInput& input) { input.base.poses.pop_back(); },
    [](PlanningInput& input) { input.base.poses.clear(); },
    [](PlanningInput& input) { input.base.poses[1].y_m = std::numeric_limits<double>::infinity(); },
    [](PlanningInput& input) { input.seen_step = {8}; },
    [](PlanningInput& input) { input.seen_step = {12}; },
    [](PlanningInput& input) { input.seen_time_s = -0.01; },
    [](PlanningInput& input) { input.seen_pose.x_m = std::numeric_limits<double>::quiet_NaN(); },
    [](PlanningInput& input) { input.deviation_m = -1.0; },
    [](PlanningInput& input) { input.path_s_m = std::numeric_limits<double>::quiet_NaN(); },
    [](PlanningInput& input) { input.area.entry->to_s_m = 2.0; },
    [](PlanningInput& input) { input.area.entry->left_m = -0.1; },
    [](PlanningInput& input) { input.area.stands_since = {12}; }};

TEST(PlanningInputTest, NonsenseIsRejected) {
  EXPECT_TRUE(is_well_formed(good(), kNow));
  for (std::size_t i = 0; i < kNonsense.size(); ++i) {
    PlanningInput input = good();
    kNonsense[i](input);
    EXPECT_FALSE(is_well_formed(input, kNow)) << i;
  }
}

// Two controllers must not take different inputs for the same.
TEST(PlanningInputTest, EveryPartChangesTheDigestOfTheTraffic) {
  const Traffic traffic{.vehicle = {1}, .step = kNow, .planning = good()};
  const std::uint64_t digest = digest_of(traffic);
  std::vector<std::function<void(PlanningInput&)>> changes = kNonsense;
  changes.emplace_back([](PlanningInput& input) { input.basis = 6; });
  changes.emplace_back([](PlanningInput& input) { input.may_plan = false; });
  changes.emplace_back([](PlanningInput& input) { input.base.maneuvers[0] = 4; });
  changes.emplace_back([](PlanningInput& input) { input.base.standstill = 1; });
  changes.emplace_back([](PlanningInput& input) { input.is_moved = true; });
  changes.emplace_back([](PlanningInput& input) { input.route = 1; });
  changes.emplace_back([](PlanningInput& input) { input.area.entry.reset(); });
  changes.emplace_back([](PlanningInput& input) { input.area.is_departing = true; });
  changes.emplace_back([](PlanningInput& input) { input.area.is_certain = false; });
  changes.emplace_back([](PlanningInput& input) { input.area.is_possible = false; });
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Traffic changed = traffic;
    changes[i](*changed.planning);
    EXPECT_NE(digest_of(changed), digest) << i;
  }
}

}  // namespace
}  // namespace hlc::coordination
