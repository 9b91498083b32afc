#include "planner/maneuver_design/energy.hpp"

#include <gtest/gtest.h>

#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc {
namespace {

double energy_of(double speed_mps, const std::vector<Input>& inputs) {
  return shoot({{}, speed_mps, 0.2}, inputs, 0.2, Energy{}, {}, WithGradient::kNo).cost;
}

TEST(Energy, OfSpeedingUpIsTheGainOfKineticEnergy) {
  EXPECT_NEAR(energy_of(0.5, {{2.0, 0.0}, {8.0, 1.0}}), (1.5 * 1.5 - 0.5 * 0.5) / 2.0, 1e-14);
}

TEST(Energy, OfBrakingIsNothingAndNothingComesBack) {
  EXPECT_EQ(energy_of(1.5, {{-2.0, 0.0}, {-8.0, 1.0}}), 0.0);
  EXPECT_NEAR(energy_of(1.0, {{5.0, 0.0}, {-5.0, 0.0}}), (1.5 * 1.5 - 1.0) / 2.0, 1e-14);
}

TEST(Energy, HasAnExactGradient) { expect_exact_gradient(Energy{}, 105); }

}  // namespace
}  // namespace hlc
