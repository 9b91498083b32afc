#include "planner/controller/drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::controller {
namespace {

constexpr double kTolerated_m = 0.005;

/// A plan from standstill at the origin at t(10) through trims by their numbers.
coordination::Plan plan_through(const std::vector<std::size_t>& trims) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  std::vector<const automaton::Maneuver*> maneuvers;
  for (std::size_t i = 1; i < trims.size(); ++i) {
    maneuvers.push_back(automaton.find(automaton::pi(trims[i - 1]), automaton::pi(trims[i]), "J2"));
  }
  const coordination::Plan standing({10}, {},
                                    *automaton.find(automaton::pi(1), automaton::pi(1), "J2"));
  return standing.continued({10}, maneuvers);
}

SeenAt seen_standing() {
  return {.step = {10},
          .time_s = 0.0,
          .pose = {0.0, 0.0,
                   automaton::yaw_minus_heading_rad(0.0, automaton::paper_automaton()->vehicle,
                                                    automaton::paper_automaton()->identified)}};
}

coordination::OccupiedAreas announced(const coordination::Plan& plan,
                                      const SeenAt& seen = seen_standing()) {
  return areas_with_drift(plan, {10}, seen, *automaton::paper_automaton(), kTolerated_m);
}

bool are_equal(const coordination::OccupiedAreas& a, const coordination::OccupiedAreas& b) {
  return a.first == b.first && a.areas_m == b.areas_m && a.final_area_m == b.final_area_m;
}

bool holds(const ConvexPolygon& area, const ConvexPolygon& other) {
  return std::ranges::all_of(other.vertices_m,
                             [&area](const Point& vertex) { return contains(area, vertex, 1e-9); });
}

TEST(Drift, APlanThatTheVehicleCanFollowKeepsItsAreasToTheBit) {
  for (const auto& trims : {std::vector<std::size_t>{1, 7, 7, 8, 9, 10, 9, 8, 1},
                            std::vector<std::size_t>{1, 7, 6, 5, 4, 3, 3, 4, 1}}) {
    const coordination::Plan plan = plan_through(trims);
    EXPECT_TRUE(are_equal(announced(plan), plan.areas_from({10})));
  }
}

TEST(Drift, AHeldTrimBeyondTheSteeringLimitWidensTheAreasFromThereOn) {
  const coordination::Plan plan = plan_through({1, 4, 3, 2, 2, 2, 2, 2, 1});
  const coordination::OccupiedAreas planned = plan.areas_from({10});
  const coordination::OccupiedAreas areas = announced(plan);
  ASSERT_EQ(areas.areas_m.size(), planned.areas_m.size());
  EXPECT_EQ(areas.areas_m.front(), planned.areas_m.front());
  EXPECT_NE(areas.areas_m.back(), planned.areas_m.back());
  EXPECT_NE(areas.final_area_m, planned.final_area_m);
  for (std::uint64_t k = 10; k < 20; ++k) {
    EXPECT_TRUE(holds(areas.during({k}), planned.during({k}))) << k;
  }
}

/// The others compare a plan with theirs until the horizon ends: what is free of its last area must
/// be free of the vehicle at rest.
TEST(Drift, TheLastAreaHoldsTheFinalOne) {
  for (const auto& trims : {std::vector<std::size_t>{1, 4, 3, 2, 2, 2, 2, 2, 1},
                            std::vector<std::size_t>{1, 12, 12, 12, 12, 12, 12, 12, 1},
                            std::vector<std::size_t>{1, 2, 1}}) {
    for (const double beside_m : {-0.03, 0.0, 0.03}) {
      SeenAt seen = seen_standing();
      seen.pose.y_m += beside_m;
      const coordination::OccupiedAreas areas = announced(plan_through(trims), seen);
      EXPECT_TRUE(contains(areas.areas_m.back(), areas.final_area_m, 5e-6)) << beside_m;
    }
  }
}

TEST(Drift, WhereTheVehicleIsPredictedIsHeldWithItsMargin) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  const coordination::Plan plan = plan_through({1, 12, 12, 12, 12, 12, 12, 12, 1});
  const coordination::OccupiedAreas areas = announced(plan);
  double largest_m = 0.0;
  for (const PredictedInstant& instant : predicted_drive(plan, seen_standing(), {20}, automaton)) {
    const double off_m = (instant.pose.position_m() - instant.planned.pose.position_m()).norm();
    largest_m = std::max(largest_m, off_m);
    const double margin_m = automaton.vehicle.safety_margin_m - kTolerated_m;
    EXPECT_TRUE(holds(areas.during(instant.step),
                      footprint_area(automaton.vehicle.footprint, instant.pose, margin_m)));
  }
  EXPECT_GT(largest_m, 0.020) << "a plan that is hard to follow";
}

TEST(Drift, AVehicleBesideItsPlanIsHeldUntilItIsBack) {
  const coordination::Plan plan = plan_through({1, 7, 7, 7, 7, 7, 7, 7, 1});
  SeenAt seen = seen_standing();
  seen.pose.y_m += 0.020;
  const coordination::OccupiedAreas planned = plan.areas_from({10});
  const coordination::OccupiedAreas areas = announced(plan, seen);
  EXPECT_NE(areas.areas_m.front(), planned.areas_m.front());
  EXPECT_EQ(areas.areas_m.back(), planned.areas_m.back());
}

}  // namespace
}  // namespace hlc::controller
