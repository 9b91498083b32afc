#pragma once

#include <gtest/gtest.h>

#include <random>

#include "planner/maneuver_design/path_constraint.hpp"
#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Compares the gradient of a running cost with central differences, to 1e-6 relative, at 200
/// random states and inputs of the lab's vehicle (both signs of everything but the speed).
inline void expect_exact_gradient(const RunningCost& cost, unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kStep = 1e-5;
  for (int run = 0; run < 200; ++run) {
    vehicle::StateVector x;
    x << unit(random), unit(random), 3.0 * unit(random), 1.5 + unit(random), 0.6 * unit(random);
    const vehicle::Input u{12.0 * unit(random), 6.0 * unit(random)};
    const CostGradient gradient = cost.gradient(x, u);
    const auto compare = [&](double exact, double above, double below) {
      EXPECT_NEAR(exact, (above - below) / (2.0 * kStep), 1e-6 * (1.0 + std::abs(exact)));
    };
    for (int i = 0; i < 5; ++i) {
      const vehicle::StateVector dx = kStep * vehicle::StateVector::Unit(i);
      compare(gradient.state(i), cost.value(x + dx, u), cost.value(x - dx, u));
    }
    const auto with = [&](double a, double rate) {
      return cost.value(x, {u.acceleration_mps2 + a, u.steering_rate_radps + rate});
    };
    compare(gradient.input.x(), with(kStep, 0.0), with(-kStep, 0.0));
    compare(gradient.input.y(), with(0.0, kStep), with(0.0, -kStep));
  }
}

/// g in the place of a cost.
class AsCost final : public RunningCost {
 public:
  explicit AsCost(const PathConstraint& constraint) : constraint_(constraint) {}
  [[nodiscard]] double value(const vehicle::StateVector& x,
                             const vehicle::Input& u) const override {
    return constraint_.value(x, u);
  }
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override {
    return constraint_.gradient(x, u);
  }

 private:
  const PathConstraint& constraint_;
};

/// The same for a g.
inline void expect_exact_gradient(const PathConstraint& constraint, unsigned seed) {
  expect_exact_gradient(AsCost(constraint), seed);
}

}  // namespace hlc::maneuver_design
