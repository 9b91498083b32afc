#include "planner/vehicle/single_track.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace hlc::vehicle {
namespace {

/// Speed and steering of the paper's Table 1.
constexpr std::array<std::array<double, 2>, 12> kTrims{{{0.0, 0.0},
                                                        {0.4, -0.60},
                                                        {0.5, -0.48},
                                                        {0.6, -0.36},
                                                        {0.7, -0.24},
                                                        {0.8, -0.12},
                                                        {0.8, 0.0},
                                                        {0.8, 0.12},
                                                        {0.7, 0.24},
                                                        {0.6, 0.36},
                                                        {0.5, 0.48},
                                                        {0.4, 0.60}}};

StateVector random_state(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  StateVector x;
  x << 5.0 * unit(random), 5.0 * unit(random), 3.0 * unit(random), 2.0 + 2.0 * unit(random),
      0.62 * unit(random);
  return x;
}

Input random_input(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return {12.0 * unit(random), 6.2 * unit(random)};
}

State integrated_in_steps(State state, const Input& input, double duration_s, int steps,
                          const VehicleParameters& vehicle) {
  for (int i = 0; i < steps; ++i) {
    state = integrated(state, input, duration_s / steps, vehicle);
  }
  return state;
}

TEST(SingleTrack, DrivesStraightWithoutSteering) {
  StateVector x;
  x << 1.0, 2.0, std::acos(0.6), 2.0, 0.0;
  StateVector expected;
  expected << 1.2, 1.6, 0.0, 3.0, -4.0;
  EXPECT_LT((derivative(x, {3.0, -4.0}, VehicleParameters{}) - expected).norm(), 1e-15);
}

TEST(SingleTrack, TurnsAboutThePointWhereTheAxlesLinesMeet) {
  // Rear axle radius L / tan(delta); the centre of gravity is l_r ahead of the rear axle.
  const VehicleParameters vehicle;
  const double delta = 0.6;
  const double rear_radius_m = vehicle.wheelbase_m / std::tan(delta);
  const double radius_m = std::hypot(rear_radius_m, vehicle.rear_axle_to_cg_m);
  EXPECT_NEAR(curvature_per_m(delta, vehicle), 1.0 / radius_m, 1e-12);
  EXPECT_NEAR(slip_angle_rad(delta, vehicle), std::atan2(vehicle.rear_axle_to_cg_m, rear_radius_m),
              1e-12);
  EXPECT_NEAR(curvature_per_m(delta, vehicle), 4.315, 1e-3);
  EXPECT_NEAR(steering_for_curvature_rad(1.0 / radius_m, vehicle), delta, 1e-12);
}

TEST(SingleTrack, VectorAndStateHoldTheSameInTheSameOrder) {
  const State state{{1.0, 2.0, 3.0}, 4.0, 5.0};
  StateVector x;
  x << 1.0, 2.0, 3.0, 4.0, 5.0;
  EXPECT_EQ(to_vector(state), x);
  EXPECT_EQ(to_state(x), state);
}

TEST(SingleTrack, JacobiansAreTheDerivativesOfTheModel) {
  constexpr unsigned kSeed = 21;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  VehicleParameters vehicle;
  vehicle.rear_axle_to_cg_m = 0.06;  // not midway, so that no factor hides behind a symmetry
  constexpr double kStep = 1e-6;
  for (int run = 0; run < 200; ++run) {
    const StateVector x = random_state(random);
    const Input u = random_input(random);
    const StateJacobian A = state_jacobian(x, vehicle);
    for (int column = 0; column < 5; ++column) {
      const StateVector dx = kStep * StateVector::Unit(column);
      const StateVector difference =
          (derivative(x + dx, u, vehicle) - derivative(x - dx, u, vehicle)) / (2.0 * kStep);
      EXPECT_LT((A.col(column) - difference).norm(), 1e-6 * (1.0 + difference.norm()));
    }
    const InputJacobian B = input_jacobian();
    const StateVector by_acceleration =
        derivative(x, {u.acceleration_mps2 + 1.0, u.steering_rate_radps}, vehicle) -
        derivative(x, u, vehicle);
    const StateVector by_rate =
        derivative(x, {u.acceleration_mps2, u.steering_rate_radps + 1.0}, vehicle) -
        derivative(x, u, vehicle);
    EXPECT_LT((B.col(0) - by_acceleration).norm(), 1e-12);
    EXPECT_LT((B.col(1) - by_rate).norm(), 1e-12);
  }
}

TEST(SingleTrack, TrimsFollowTheirClosedForm) {
  const VehicleParameters vehicle;
  for (const auto& [speed_mps, steering_rad] : kTrims) {
    const State start{{1.0, -2.0, 0.7}, speed_mps, steering_rad};
    const State end = integrated_in_steps(start, {}, 0.2, 20, vehicle);
    const Pose exact = trim_motion(start.pose, speed_mps, steering_rad, 0.2, vehicle);
    EXPECT_LT((end.pose.position_m() - exact.position_m()).norm(), 1e-10);
    EXPECT_NEAR(end.pose.heading_rad, exact.heading_rad, 1e-12);
    EXPECT_EQ(end.speed_mps, speed_mps);
    EXPECT_EQ(end.steering_rad, steering_rad);
  }
}

TEST(SingleTrack, TheClosedFormHasNoGapBetweenArcAndStraightLine) {
  const VehicleParameters vehicle;
  for (double steering_rad = 1e-12; steering_rad < 0.1; steering_rad *= 3.0) {
    const State start{{}, 0.8, steering_rad};
    const State end = integrated_in_steps(start, {}, 0.2, 20, vehicle);
    const Pose exact = trim_motion({}, 0.8, steering_rad, 0.2, vehicle);
    EXPECT_LT((end.pose.position_m() - exact.position_m()).norm(), 1e-12) << steering_rad;
  }
}

TEST(SingleTrack, TheIntegratorIsOfOrderFour) {
  const VehicleParameters vehicle;
  const State start{{}, 0.5, -0.3};
  const Input input{8.0, 4.0};
  const auto end = [&](int steps) {
    return integrated_in_steps(start, input, 0.2, steps, vehicle).pose.position_m();
  };
  const Point exact = end(1000);
  const double ratio = (end(10) - exact).norm() / (end(20) - exact).norm();
  EXPECT_GT(ratio, 14.0);
  EXPECT_LT(ratio, 18.0);
}

TEST(SingleTrack, SpeedAndSteeringGrowLinearly) {
  const State end = integrated({{}, 0.5, -0.3}, {8.0, 4.0}, 0.1, VehicleParameters{});
  EXPECT_NEAR(end.speed_mps, 1.3, 1e-15);
  EXPECT_NEAR(end.steering_rad, 0.1, 1e-15);
}

TEST(SingleTrack, AShiftBeforeTheMotionEqualsTheSameShiftAfterIt) {
  constexpr unsigned kSeed = 22;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const VehicleParameters vehicle;
  for (int run = 0; run < 200; ++run) {
    const State start = to_state(random_state(random));
    const Input input = random_input(random);
    const Pose shift = to_state(random_state(random)).pose;
    State shifted = start;
    shifted.pose = compose(shift, start.pose);
    const Pose before = integrated(shifted, input, 0.2, vehicle).pose;
    const Pose after = compose(shift, integrated(start, input, 0.2, vehicle).pose);
    EXPECT_LT((before.position_m() - after.position_m()).norm(), 1e-12);
    EXPECT_NEAR(before.heading_rad, after.heading_rad, 1e-12);

    const Pose trim_before = trim_motion(shifted.pose, 0.8, 0.3, 0.2, vehicle);
    const Pose trim_after = compose(shift, trim_motion(start.pose, 0.8, 0.3, 0.2, vehicle));
    EXPECT_LT((trim_before.position_m() - trim_after.position_m()).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace hlc::vehicle
