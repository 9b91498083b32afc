#include "planner/vehicle/identified_motion.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hlc::plant {
namespace {

const vehicle::IdentifiedVehicle kVehicle;

// The formula of the lab's model, written once more with the lab's names.
vehicle::VehicleMotion euler_step(const vehicle::VehicleMotion& x, const vehicle::ActuatorInput& u,
                                  double V) {
  const double p[] = {0.0,       1.004582, -0.142938, 0.195236, 3.560576, -2.190728,
                      -9.726828, 2.515565, 1.321199,  0.032208, -0.012863};
  const double delta = u.steering + p[9];
  const double path_speed = p[1] * x.speed_mps * (1 + p[2] * delta * delta);
  const double course = x.pose.heading_rad + p[3] * delta + p[10];
  const double sign = u.throttle > 0 ? 1 : (u.throttle < 0 ? -1 : 0);
  const double thrust = (p[6] + p[7] * V) * sign * std::pow(std::abs(u.throttle), p[8]);
  const double dt = 0.02;
  return {.pose = {.x_m = x.pose.x_m + dt * path_speed * std::cos(course),
                   .y_m = x.pose.y_m + dt * path_speed * std::sin(course),
                   .heading_rad = x.pose.heading_rad + dt * p[4] * x.speed_mps * delta},
          .speed_mps = x.speed_mps + dt * (p[5] * x.speed_mps + thrust)};
}

TEST(IdentifiedMotion, StepIsTheLabsFormula) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const vehicle::VehicleMotion motion{
        .pose = {.x_m = 4 * unit(random), .y_m = 4 * unit(random), .heading_rad = 4 * unit(random)},
        .speed_mps = 4 * unit(random)};
    const vehicle::ActuatorInput input{.throttle = unit(random), .steering = unit(random)};
    const double voltage_v = 7.6 + 0.6 * unit(random);
    const vehicle::VehicleMotion got = vehicle::stepped(motion, input, kVehicle, voltage_v);
    const vehicle::VehicleMotion want = euler_step(motion, input, voltage_v);
    EXPECT_NEAR(got.pose.x_m, want.pose.x_m, 1e-12);
    EXPECT_NEAR(got.pose.y_m, want.pose.y_m, 1e-12);
    EXPECT_NEAR(got.pose.heading_rad, want.pose.heading_rad, 1e-12);
    EXPECT_NEAR(got.speed_mps, want.speed_mps, 1e-12);
  }
}

TEST(IdentifiedMotion, ThrottleForAccelerationInvertsTheModel) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double speed_mps = 4 * unit(random);
    const double throttle = unit(random);
    const double acceleration_mps2 =
        vehicle::identified_acceleration_mps2(speed_mps, throttle, kVehicle);
    EXPECT_NEAR(vehicle::throttle_for_acceleration(acceleration_mps2, speed_mps, kVehicle),
                throttle, 1e-12);
  }
}

TEST(IdentifiedMotion, ThrottleOutOfReachIsClamped) {
  EXPECT_EQ(vehicle::throttle_for_acceleration(50.0, 0.0, kVehicle), 1.0);
  EXPECT_EQ(vehicle::throttle_for_acceleration(-50.0, 0.0, kVehicle), -1.0);
}

TEST(IdentifiedMotion, SteadyThrottleIsAsMeasuredInTheLab) {
  EXPECT_NEAR(vehicle::throttle_for_acceleration(0.0, 0.4, kVehicle), 0.160, 0.001);
  EXPECT_NEAR(vehicle::throttle_for_acceleration(0.0, 0.8, kVehicle), 0.270, 0.001);
  EXPECT_NEAR(vehicle::throttle_for_acceleration(0.0, 1.0, kVehicle), 0.319, 0.001);
}

TEST(IdentifiedMotion, SteeringForSlipInvertsTheSlip) {
  for (double steering = -1.0; steering <= 1.0; steering += 0.125) {
    EXPECT_NEAR(
        vehicle::steering_for_slip(vehicle::identified_slip_rad(steering, kVehicle), kVehicle),
        steering, 1e-12);
  }
}

TEST(IdentifiedMotion, StopInputBrakesStraight) {
  EXPECT_EQ(vehicle::stop_input(1.0), (vehicle::ActuatorInput{.throttle = -0.5, .steering = 0.0}));
  EXPECT_EQ(vehicle::stop_input(0.0).throttle, 0.0);
  EXPECT_EQ(vehicle::stop_input(3.0).throttle, -1.0);
  EXPECT_EQ(vehicle::stop_input(-3.0).throttle, 1.0);
}

}  // namespace
}  // namespace hlc::plant
