#include "planner/maneuver_design/unit_cost.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/shooting.hpp"

namespace hlc::maneuver_design {
namespace {

TEST(UnitCost, OfATrimIsThereUnlessTheCriterionDependsOnThePose) {
  const vehicle::VehicleParameters vehicle;
  const automaton::Trim trim{0.8, 0.3};
  for (const std::string& name : criterion_names()) {
    SCOPED_TRACE(name);
    const auto cost = make_criterion(name, vehicle);
    const bool by_pose = name == "J1" || name == "J3" || name == "stopping_distance";
    EXPECT_EQ(unit_cost(trim, *cost).has_value(), !by_pose);
  }
  EXPECT_EQ(unit_cost(trim, *make_criterion("J2", vehicle)), 0.0);
  EXPECT_EQ(unit_cost(trim, *make_criterion("travel_time", vehicle)), 1.0);
}

TEST(UnitCost, CostOfAStepIsTheIntegralOverTheTrimFromItsOwnStart) {
  const vehicle::VehicleParameters vehicle;
  for (const automaton::Trim& trim : {automaton::Trim{0.8, 0.0}, automaton::Trim{0.4, 0.6},
                                      automaton::Trim{0.0, 0.0}, automaton::Trim{0.7, -0.2}}) {
    for (const std::string& name : criterion_names()) {
      SCOPED_TRACE(name);
      const auto cost = make_criterion(name, vehicle);
      const std::vector<vehicle::Input> none(50);
      const Shot shot = shoot({{}, trim.speed_mps, trim.steering_rad}, none, 0.2, *cost, vehicle,
                              WithGradient::kNo);
      EXPECT_NEAR(trim_step_cost(trim, 0.2, *cost, vehicle), shot.cost, 1e-10);
    }
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
