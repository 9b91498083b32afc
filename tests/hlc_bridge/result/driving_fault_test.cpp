#include "hlc_bridge/result/driving_fault.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_automaton.hpp"

namespace hlc::result::driving_fault_test {
namespace {

RunSummary summary_of_two() {
  RunSummary summary;
  summary.description.automaton =
      std::make_shared<const automaton::Subgraph>(test::make_test_subgraph());
  summary.vehicles.resize(2);
  summary.vehicles[0].id = VehicleId{1};
  summary.vehicles[1].id = VehicleId{2};
  return summary;
}

TEST(DrivingFault, WhoKeptToHisAreasAndTouchedNobodyDroveWell) {
  RunSummary summary = summary_of_two();
  EXPECT_EQ(driving_fault(summary), "");
  summary.vehicles[1].deviation_max_m = 0.010;
  summary.vehicles[1].fallback_steps = 3;
  EXPECT_EQ(driving_fault(summary), "");
  EXPECT_EQ(danger_of(summary), "");
}

TEST(DrivingFault, WhoLeftHisPlanByMoreThanTheMarginButNotHisAreasEndangeredNobody) {
  RunSummary summary = summary_of_two();
  summary.vehicles[1].deviation_max_m = 0.0104;
  EXPECT_EQ(
      driving_fault(summary),
      "vehicle 2 deviated by up to 10.4 mm from its plan, more than the safety margin of 10.0 mm");
  EXPECT_EQ(danger_of(summary), "");
}

TEST(DrivingFault, WhoDeviatedAsUndisturbedCarsOfItsLabDoDroveWell) {
  RunSummary summary = summary_of_two();
  summary.description.tracking_error_max_m = 0.035;
  summary.vehicles[1].deviation_max_m = 0.035;
  EXPECT_EQ(driving_fault(summary), "");
  summary.vehicles[1].deviation_max_m = 0.036;
  EXPECT_EQ(driving_fault(summary),
            "vehicle 2 deviated by up to 36.0 mm from its plan, more than undisturbed ones of its "
            "lab do, 35.0 mm");
}

TEST(DrivingFault, NamesTouchesAndStepsOutsideTheAreas) {
  RunSummary summary = summary_of_two();
  summary.vehicles[1].steps_outside_announced_area = 4;
  EXPECT_EQ(driving_fault(summary), "vehicle 2 left its announced areas in 4 steps");
  EXPECT_EQ(danger_of(summary), driving_fault(summary));
  summary.collisions = 2;
  EXPECT_EQ(driving_fault(summary), "vehicles collided 2 times");
}

}  // namespace
}  // namespace hlc::result::driving_fault_test
