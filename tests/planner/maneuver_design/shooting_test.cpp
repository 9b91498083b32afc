#include "planner/maneuver_design/shooting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/distance.hpp"
#include "planner/maneuver_design/effort.hpp"

namespace hlc::maneuver_design {
namespace {

std::vector<vehicle::Input> random_inputs(std::mt19937& random, std::size_t size) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<vehicle::Input> inputs;
  for (std::size_t i = 0; i < size; ++i) {
    inputs.push_back({12.0 * unit(random), 6.2 * unit(random)});
  }
  return inputs;
}

TEST(Shooting, StatesAreThoseOfTheIntegrator) {
  std::mt19937 random(61);
  const std::vector<vehicle::Input> inputs = random_inputs(random, 20);
  const vehicle::State start{{0.1, 0.2, 0.3}, 1.0, 0.1};
  const vehicle::VehicleParameters vehicle;
  const Shot shot = shoot(start, inputs, 0.2, Distance{}, vehicle, WithGradient::kNo);
  ASSERT_EQ(shot.states.size(), 21U);
  EXPECT_TRUE(shot.gradient.empty());
  vehicle::State state = start;
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_LT((vehicle::to_vector(shot.states[k]) - vehicle::to_vector(state)).norm(), 1e-14);
    state = vehicle::integrated(state, inputs[k], 0.01, vehicle);
  }
}

TEST(Shooting, CostIsTheIntegralOfTheRunningCost) {
  // Straight at v = 1 m/s: J1 = -integral of t^2 = -T^3 / 3. Runge-Kutta is exact for it.
  const std::vector<vehicle::Input> none(7);
  const vehicle::State start{{}, 1.0, 0.0};
  EXPECT_NEAR(shoot(start, none, 0.3, Distance{}, {}, WithGradient::kNo).cost, -0.009, 1e-15);
  const std::vector<vehicle::Input> inputs{{3.0, 4.0}, {0.0, 1.0}};
  EXPECT_NEAR(shoot(start, inputs, 0.2, Effort{}, {}, WithGradient::kNo).cost, 2.6, 1e-14);
}

TEST(Shooting, GradientIsTheDerivativeOfTheCost) {
  constexpr unsigned kSeed = 62;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const Distance distance;
  const Effort effort;
  const vehicle::VehicleParameters vehicle;
  constexpr double kStep = 1e-4;
  for (const RunningCost* const cost :
       {static_cast<const RunningCost*>(&distance), static_cast<const RunningCost*>(&effort)}) {
    for (int run = 0; run < 10; ++run) {
      const vehicle::State start{{}, 2.0, 0.1};
      const std::vector<vehicle::Input> inputs = random_inputs(random, 20);
      const Shot shot = shoot(start, inputs, 0.2, *cost, vehicle, WithGradient::kYes);
      double scale = 0.0;
      for (const Eigen::Vector2d& gradient : shot.gradient) {
        scale = std::max(scale, gradient.norm());
      }
      const auto cost_of = [&](std::size_t k, const vehicle::Input& input) {
        std::vector<vehicle::Input> changed = inputs;
        changed[k] = input;
        return shoot(start, changed, 0.2, *cost, vehicle, WithGradient::kNo).cost;
      };
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        const vehicle::Input& u = inputs[k];
        const double by_acceleration =
            (cost_of(k, {u.acceleration_mps2 + kStep, u.steering_rate_radps}) -
             cost_of(k, {u.acceleration_mps2 - kStep, u.steering_rate_radps})) /
            (2.0 * kStep);
        const double by_rate = (cost_of(k, {u.acceleration_mps2, u.steering_rate_radps + kStep}) -
                                cost_of(k, {u.acceleration_mps2, u.steering_rate_radps - kStep})) /
                               (2.0 * kStep);
        EXPECT_NEAR(shot.gradient[k].x(), by_acceleration, 1e-6 * scale);
        EXPECT_NEAR(shot.gradient[k].y(), by_rate, 1e-6 * scale);
      }
    }
  }
}

TEST(Shooting, DurationGradientIsTheDerivativeOfTheCostByTheDuration) {
  constexpr unsigned kSeed = 63;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  std::mt19937 random(kSeed);
  const vehicle::VehicleParameters vehicle;
  constexpr double kStep = 1e-5;
  for (const std::string& name : criterion_names()) {
    SCOPED_TRACE(name);
    const auto cost = make_criterion(name, vehicle);
    for (int run = 0; run < 10; ++run) {
      const vehicle::State start{{}, 2.0, 0.1};
      const std::vector<vehicle::Input> inputs = random_inputs(random, 20);
      const auto cost_of = [&](double duration_s) {
        return shoot(start, inputs, duration_s, *cost, vehicle, WithGradient::kNo).cost;
      };
      const double exact =
          shoot(start, inputs, 0.2, *cost, vehicle, WithGradient::kYes).duration_gradient;
      EXPECT_NEAR(exact, (cost_of(0.2 + kStep) - cost_of(0.2 - kStep)) / (2.0 * kStep),
                  1e-6 * std::abs(exact));
    }
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
