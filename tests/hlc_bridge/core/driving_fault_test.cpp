#include "hlc_bridge/core/driving_fault.hpp"

#include <gtest/gtest.h>

namespace hlc {
namespace {

RunSummary summary_of_two() {
  RunSummary summary;
  summary.vehicles.resize(2);
  summary.vehicles[0].id = VehicleId{1};
  summary.vehicles[1].id = VehicleId{2};
  return summary;
}

TEST(DrivingFault, WhoKeptToHisAreasAndTouchedNobodyDroveWell) {
  RunSummary summary = summary_of_two();
  EXPECT_EQ(fault_of(summary), "");
  summary.vehicles[1].deviation_max_m = 0.05;  // within the areas, or the steps would be astray
  summary.vehicles[1].fallback_steps = 3;
  EXPECT_EQ(fault_of(summary), "");
}

TEST(DrivingFault, NamesTouchesAndStepsOutsideTheAreas) {
  RunSummary summary = summary_of_two();
  summary.vehicles[1].astray_steps = 4;
  EXPECT_EQ(fault_of(summary),
            "vehicle 2 was outside the areas that it had told the others in 4 steps");
  summary.collisions = 2;
  EXPECT_EQ(fault_of(summary), "vehicles touched each other 2 times");
}

}  // namespace
}  // namespace hlc
