#include "planner/maneuver_design/energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/maneuver_design/gradient_check.hpp"

namespace hlc::maneuver_design {
namespace {

double energy_of(double speed_mps, const std::vector<vehicle::Input>& inputs) {
  return shoot({{}, speed_mps, 0.2}, inputs, 0.2, Energy{}, {}, WithGradient::kNo).cost;
}

TEST(Energy, OfSpeedingUpIsTheGainOfKineticEnergy) {
  EXPECT_NEAR(energy_of(0.5, {{2.0, 0.0}, {8.0, 1.0}}), (1.5 * 1.5 - 0.5 * 0.5) / 2.0, 1e-14);
}

TEST(Energy, OfBrakingIsNothingAndNothingComesBack) {
  EXPECT_EQ(energy_of(1.5, {{-2.0, 0.0}, {-8.0, 1.0}}), 0.0);
  EXPECT_NEAR(energy_of(1.0, {{5.0, 0.0}, {-5.0, 0.0}}), (1.5 * 1.5 - 1.0) / 2.0, 1e-14);
}

TEST(Energy, IsThePositivePartOfThePowerWithoutItsKink) {
  const vehicle::StateVector x = vehicle::to_vector({{}, 2.0, 0.1});
  constexpr double kStep = 1e-9;
  for (double a = -0.01; a < 0.03; a += 0.0007) {
    SCOPED_TRACE(a);
    const double exact = 2.0 * std::max(a, 0.0);
    const double value = Energy{}.value(x, {a, 0.0});
    EXPECT_LE(value, exact + 1e-15);
    EXPECT_GE(value, exact - 2.0 * 0.15 * kCoastingBand_mps2);
    if (a <= 0.0 || a >= kCoastingBand_mps2) {
      EXPECT_DOUBLE_EQ(value, exact);
    }
    const double slope = Energy{}.gradient(x, {a, 0.0}).input.x();
    const double difference = (Energy{}.value(x, {a + kStep, 0.0}) - value) / kStep;
    EXPECT_NEAR(slope, difference, 1e-5);
  }
}

TEST(Energy, HasAnExactGradient) { expect_exact_gradient(Energy{}, 105); }

}  // namespace
}  // namespace hlc::maneuver_design
