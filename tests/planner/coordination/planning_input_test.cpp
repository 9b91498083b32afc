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
    [](PlanningInput& input) { input.base.first = {8}; },
    [](PlanningInput& input) { input.base.first = {11}; },
    [](PlanningInput& input) { input.base.poses.pop_back(); },
    [](PlanningInput& input) { input.base.poses.clear(); },
    [](PlanningInput& input) { input.base.poses[1].y_m = std::numeric_limits<double>::infinity(); },
    [](PlanningInput& input) { input.seen_step = {8}; },
    [](PlanningInput& input) { input.seen_step = {11}; },
    [](PlanningInput& input) { input.seen_time_s = 11.0; },
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

TEST(Digest, EveryPartChangesThatOfATraffic) {
  const ConvexPolygon square{{Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)}};
  const OccupiedAreas areas{.first = kNow, .areas_m = {square}, .final_area_m = square};
  const Traffic traffic{.vehicle = {1},
                        .step = kNow,
                        .next_trim = {2},
                        .running = areas,
                        .reachable_area_m = square,
                        .claim = LaneClaim{.route = 1, .place_m = 2.0, .ahead_m = 3.0}};
  const std::vector<std::function<void(Traffic&)>> changes{
      [](Traffic& one) { one.vehicle = {2}; },
      [](Traffic& one) { one.step = {11}; },
      [](Traffic& one) { one.next_pose.x_m = 0.1; },
      [](Traffic& one) { one.next_pose.y_m = 0.1; },
      [](Traffic& one) { one.next_pose.heading_rad = 0.1; },
      [](Traffic& one) { one.next_trim = {1}; },
      [](Traffic& one) { one.running.first = {11}; },
      [](Traffic& one) { one.running.areas_m.clear(); },
      [](Traffic& one) { one.running.areas_m[0].vertices_m[2].x() = 1.1; },
      [](Traffic& one) { one.running.final_area_m.vertices_m[2].y() = 1.1; },
      [](Traffic& one) { one.reachable_area_m.vertices_m[0].x() = -0.1; },
      [](Traffic& one) { one.silent = {{3}}; },
      [](Traffic& one) { one.standing_steps = 1; },
      [](Traffic& one) { one.reference_areas_m = {one.reachable_area_m}; },
      [](Traffic& one) { one.claim.reset(); },
      [](Traffic& one) { one.claim->route = 0; },
      [](Traffic& one) { one.claim->place_m = 2.1; },
      [](Traffic& one) { one.claim->ahead_m = 3.1; },
      [](Traffic& one) { one.claim->waiting_steps = 1; },
      [](Traffic& one) { one.planning = good(); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Traffic changed = traffic;
    changes[i](changed);
    EXPECT_NE(digest_of(changed), digest_of(traffic)) << i;
  }
}

// A plan counts as known if the digests of two predictions are the same.
TEST(Digest, EveryPartChangesThatOfAPrediction) {
  const ConvexPolygon square{{Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)}};
  const OccupiedAreas areas{.first = kNow, .areas_m = {square}, .final_area_m = square};
  const Prediction prediction{
      .vehicle = {1}, .step = kNow, .is_new = true, .areas = areas, .desired = areas};
  const std::vector<std::function<void(Prediction&)>> changes{
      [](Prediction& one) { one.vehicle = {2}; },
      [](Prediction& one) { one.step = {11}; },
      [](Prediction& one) { one.is_new = false; },
      [](Prediction& one) { one.areas.first = {11}; },
      [](Prediction& one) { one.areas.areas_m.push_back(one.areas.areas_m[0]); },
      [](Prediction& one) { one.areas.areas_m[0].vertices_m[3].y() = 1.1; },
      [](Prediction& one) { one.areas.final_area_m.vertices_m[3].y() = 1.1; },
      [](Prediction& one) { one.desired.reset(); },
      [](Prediction& one) { one.desired->final_area_m.vertices_m[3].y() = 1.1; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Prediction changed = prediction;
    changes[i](changed);
    EXPECT_NE(digest_of(changed), digest_of(prediction)) << i;
  }
}

}  // namespace
}  // namespace hlc::coordination
