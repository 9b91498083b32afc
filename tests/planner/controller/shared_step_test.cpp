#include "planner/controller/shared_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/footprint.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller::shared_step_test {
namespace {

using coordination::Traffic;
using testing::ElementsAre;
using testing::Pair;

const coordination::PriorityRule kSmallerIdFirst;
const coordination::PriorityRule kTwoFirst{.first = {{3}, {2}}};

Traffic reaching(std::uint8_t vehicle, double x_m) {
  return {.vehicle = {vehicle}, .reachable_area_m = footprint_area({1.0, 1.0}, {x_m, 0.0, 0.0})};
}

TEST(SharedStep, IsComputedOnceForEqualTraffic) {
  const Traffic one = reaching(1, 0.0);
  const Traffic two = reaching(2, 0.5);
  const Traffic copy = one;
  SharedStep shared;
  const auto* const graph =
      &shared.coupling({&two, &one}, kSmallerIdFirst, coordination::kReachableAreas).graph;
  const VehicleId* const vehicles = graph->vehicles().data();
  const auto& again =
      shared.coupling({&copy, &two}, kSmallerIdFirst, coordination::kReachableAreas);
  EXPECT_EQ(again.graph.vehicles().data(), vehicles) << "kept";
}

TEST(SharedStep, IsComputedAgainForEveryOtherInput) {
  const Traffic one = reaching(1, 0.0);
  const Traffic two = reaching(2, 0.5);
  const Traffic far = reaching(2, 5.0);
  const Traffic three = reaching(3, 0.5);
  SharedStep shared;
  const auto levels = [&](std::vector<const Traffic*> traffic,
                          const coordination::PriorityRule& priorities,
                          const coordination::CouplingRule& rule = coordination::kReachableAreas) {
    return shared.coupling(std::move(traffic), priorities, rule).levels;
  };
  EXPECT_THAT(levels({&one, &two}, kSmallerIdFirst),
              ElementsAre(Pair(VehicleId{1}, 0), Pair(VehicleId{2}, 1)));
  EXPECT_THAT(levels({&one, &two}, kTwoFirst),
              ElementsAre(Pair(VehicleId{1}, 1), Pair(VehicleId{2}, 0)));
  EXPECT_THAT(levels({&one, &far}, kTwoFirst),
              ElementsAre(Pair(VehicleId{1}, 0), Pair(VehicleId{2}, 0)));
  EXPECT_THAT(levels({&one, &far}, kTwoFirst, coordination::kAllVehicles),
              ElementsAre(Pair(VehicleId{1}, 1), Pair(VehicleId{2}, 0)));
  EXPECT_THAT(levels({&one, &three}, kTwoFirst),
              ElementsAre(Pair(VehicleId{1}, 1), Pair(VehicleId{3}, 0)));
  EXPECT_THAT(levels({&one}, kTwoFirst), ElementsAre(Pair(VehicleId{1}, 0)));
}

/// A closed route of 8 m without crossings.
right_of_way::ConflictMap ring() {
  const road::ReferencePath path(
      {Point(0.0, 0.0), Point(2.0, 0.0), Point(2.0, 2.0), Point(0.0, 2.0)}, true);
  return {std::vector<road::DrivableRoute>{{.name = "ring", .path = path}},
          automaton::paper_automaton()->vehicle};
}

TEST(SharedStep, GrantsAreThoseOfWhatIsHeldAndBlocked) {
  const right_of_way::ConflictMap map = ring();
  const right_of_way::ConflictMap other_map = ring();
  const std::vector<right_of_way::Holder> alone{{{1}, {.place_m = 1.0}}};
  const std::vector<right_of_way::Holder> both{{{1}, {.place_m = 0.5}}, {{2}, {.place_m = 1.2}}};
  const std::vector<right_of_way::Holder> moved{{{1}, {.place_m = 0.5}}, {{2}, {.place_m = 1.3}}};
  const std::vector<right_of_way::Blocked> here{
      {VehicleId{3}, footprint_area({0.2, 0.2}, {1.6, 0.0, 0.0})}};
  const std::vector<right_of_way::Blocked> there{
      {VehicleId{3}, footprint_area({0.2, 0.2}, {1.7, 0.0, 0.0})}};
  SharedStep shared;
  std::vector<std::vector<right_of_way::Taken>> seen;
  const auto expect_granted =
      [&](const right_of_way::ConflictMap& of, const auto& holders, const auto& blocked,
          double look_ahead_m, const right_of_way::GrantOrder& order = right_of_way::kLongestWait) {
        const std::vector<right_of_way::Taken> taken =
            shared.taken(of, holders, blocked, look_ahead_m, order);
        const std::vector<double> granted =
            right_of_way::grant(of, holders, blocked, look_ahead_m, order);
        EXPECT_EQ(taken, right_of_way::leave_a_way_on(of, holders, granted, blocked, order));
        EXPECT_EQ(shared.taken(of, holders, blocked, look_ahead_m, order), taken);
        seen.push_back(taken);
      };
  const std::vector<right_of_way::Blocked> none;
  expect_granted(map, alone, none, 1.0);
  expect_granted(map, alone, here, 1.0);
  expect_granted(map, alone, there, 1.0);
  expect_granted(map, both, none, 1.0);
  expect_granted(map, moved, none, 1.0);
  expect_granted(map, moved, none, 0.5);
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_NE(seen[i], seen[i - 1]) << i;
  expect_granted(other_map, moved, none, 0.5);
  static bool is_asked = false;
  const right_of_way::GrantOrder asking{
      .name = "asking", .is_before = [](const right_of_way::Holder&, const right_of_way::Holder&) {
        is_asked = true;
        return false;
      }};
  static_cast<void>(shared.taken(other_map, moved, none, 0.5, asking));
  EXPECT_TRUE(is_asked) << "grants of another order were kept";
}

}  // namespace
}  // namespace hlc::controller::shared_step_test
