#include "planner/maneuver_design/criteria.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace hlc {
namespace {

TEST(Criteria, EffortIsTheSquareOfTheInput) {
  const auto effort = make_criterion("J2");
  EXPECT_EQ(effort->value(StateVector::Zero(), {3.0, -4.0}), 25.0);
}

TEST(Criteria, GradientsAreTheDerivativesOfTheRunningCosts) {
  constexpr unsigned kSeed = 51;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kStep = 1e-5;
  for (const std::string& name : criterion_names()) {
    SCOPED_TRACE(name);
    const auto cost = make_criterion(name);
    for (int run = 0; run < 100; ++run) {
      const StateVector x = StateVector::NullaryExpr([&] { return unit(random); });
      const Input u{12.0 * unit(random), 6.0 * unit(random)};
      const CostGradient gradient = cost->gradient(x, u);
      for (int i = 0; i < 5; ++i) {
        const StateVector dx = kStep * StateVector::Unit(i);
        EXPECT_NEAR(gradient.state(i),
                    (cost->value(x + dx, u) - cost->value(x - dx, u)) / (2 * kStep), 1e-6);
      }
      const Input a1{u.acceleration_mps2 + kStep, u.steering_rate_radps};
      const Input a0{u.acceleration_mps2 - kStep, u.steering_rate_radps};
      EXPECT_NEAR(gradient.input.x(), (cost->value(x, a1) - cost->value(x, a0)) / (2 * kStep),
                  1e-6);
      const Input w1{u.acceleration_mps2, u.steering_rate_radps + kStep};
      const Input w0{u.acceleration_mps2, u.steering_rate_radps - kStep};
      EXPECT_NEAR(gradient.input.y(), (cost->value(x, w1) - cost->value(x, w0)) / (2 * kStep),
                  1e-6);
    }
  }
}

TEST(Criteria, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    (void)make_criterion("J0");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "criterion = J0, allowed J2");
  }
}

}  // namespace
}  // namespace hlc
