#include "vehicle_sim/plant/plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace hlc::plant {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Plant plant_at_origin() { return Plant(PlantOptions{}); }

/// Radius of the circle that the plant drives in the end with this steering.
double steady_radius_m(double steering) {
  Plant plant = plant_at_origin();
  const vehicle::ActuatorInput input{.throttle = 0.16, .steering = steering};
  for (int i = 0; i < 500; ++i) {
    plant.step(input);
  }
  // The yaw turns by the same angle in every tick; the positions form a regular polygon.
  const vehicle::VehicleMotion a = plant.motion();
  plant.step(input);
  const vehicle::VehicleMotion b = plant.motion();
  const double side_m = (b.pose.position_m() - a.pose.position_m()).norm();
  const double angle_rad = b.pose.heading_rad - a.pose.heading_rad;
  return side_m / (2.0 * std::sin(angle_rad / 2.0));
}

TEST(Plant, StandsWhereItStartsUntilItIsDriven) {
  const Pose start{.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.5};
  Plant plant({.start = start});
  for (int i = 0; i < 100; ++i) {
    plant.step({});
  }
  EXPECT_EQ(plant.motion().pose, start);
  EXPECT_EQ(plant.motion().speed_mps, 0.0);
}

TEST(Plant, InputActsAfterEightyMilliseconds) {
  Plant plant = plant_at_origin();
  plant.step({.throttle = 1.0});
  for (int i = 0; i < 3; ++i) {
    plant.step({});
    EXPECT_EQ(plant.motion().speed_mps, 0.0) << i;
  }
  plant.step({});  // from tick 4 to tick 5
  EXPECT_GT(plant.motion().speed_mps, 0.1);
  const double after_mps = plant.motion().speed_mps;
  plant.step({});
  EXPECT_LT(plant.motion().speed_mps, after_mps) << "one input acts for one tick";
}

TEST(Plant, FullThrottleEndsAtTheLabsSpeed) {
  Plant plant = plant_at_origin();
  for (int i = 0; i < 500; ++i) {
    plant.step({.throttle = 1.0});
  }
  EXPECT_NEAR(plant.motion().speed_mps, 4.52, 0.01);
}

TEST(Plant, TurnsAsTightlyAsTheLabsVehicle) {
  EXPECT_NEAR(1.0 / steady_radius_m(1.0), 4.316, 0.002);
  EXPECT_NEAR(1.0 / steady_radius_m(-1.0), -3.960, 0.002);
}

TEST(Plant, InputsBeyondTheActuatorsAreClamped) {
  Plant wild = plant_at_origin();
  Plant tame = plant_at_origin();
  for (int i = 0; i < 50; ++i) {
    wild.step({.throttle = 7.0, .steering = -3.0});
    tame.step({.throttle = 1.0, .steering = -1.0});
  }
  EXPECT_EQ(wild.motion(), tame.motion());
}

TEST(Plant, InputThatIsNotFiniteBrakes) {
  for (const vehicle::ActuatorInput bad :
       {vehicle::ActuatorInput{.throttle = kNan, .steering = 0.5},
        vehicle::ActuatorInput{.throttle = 1.0, .steering = kNan},
        vehicle::ActuatorInput{.throttle = kInfinity, .steering = 0.0},
        vehicle::ActuatorInput{.throttle = 0.0, .steering = -kInfinity}}) {
    Plant plant = plant_at_origin();
    for (int i = 0; i < 200; ++i) {
      plant.step({.throttle = 0.319});
    }
    ASSERT_NEAR(plant.motion().speed_mps, 1.0, 0.01);
    for (int i = 0; i < 100; ++i) {
      plant.step(bad);
    }
    EXPECT_NEAR(plant.motion().speed_mps, 0.0, 0.02);
    EXPECT_TRUE(std::isfinite(plant.motion().pose.x_m));
    EXPECT_NEAR(plant.motion().pose.heading_rad, 0.0, 0.5) << "steering 0 while it brakes";
  }
}

TEST(Plant, StopLawBrakesAsMeasuredInTheLab) {
  // Wire contract 6.1: from 1 m/s to 0.2 m/s within 0.2 s, standstill in about 0.4 s; plus 80 ms
  // delay.
  Plant plant = plant_at_origin();
  for (int i = 0; i < 200; ++i) {
    plant.step({.throttle = 0.319});
  }
  const auto brake_for = [&plant](double duration_s) {
    for (int i = 0; i < static_cast<int>(std::lround(duration_s / vehicle::kIdentifiedStep_s));
         ++i) {
      plant.step(vehicle::stop_input(plant.motion().speed_mps));
    }
    return plant.motion().speed_mps;
  };
  EXPECT_LT(brake_for(0.08 + 0.20), 0.25);
  EXPECT_NEAR(brake_for(0.20), 0.0, 0.05);
}

TEST(Plant, ExactMeasurementIsTheTruth) {
  Plant plant({.start = {.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.5}});
  for (int i = 0; i < 100; ++i) {
    const Measurement measured = plant.measure();
    EXPECT_EQ(measured.pose, plant.motion().pose);
    EXPECT_EQ(measured.speed_mps, plant.motion().speed_mps);
    plant.step({.throttle = 0.3, .steering = 0.4});
  }
}

TEST(Plant, InertialSensorsAndOdometerAgreeWithTheMotion) {
  Plant plant = plant_at_origin();
  double yaw_before_rad = 0.0;
  double speed_before_mps = 0.0;
  double distance_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    plant.step({.throttle = i < 100 ? 0.3 : -0.1, .steering = i < 100 ? 0.4 : -0.4});
    const Measurement measured = plant.measure();
    const vehicle::VehicleMotion& motion = plant.motion();
    distance_m += vehicle::kIdentifiedStep_s * std::abs(speed_before_mps);
    EXPECT_NEAR(measured.odometer_m, distance_m, 1e-9);
    EXPECT_NEAR(measured.acceleration_forward_mps2,
                (motion.speed_mps - speed_before_mps) / vehicle::kIdentifiedStep_s, 1e-9);
    const double yaw_rate_radps =
        (motion.pose.heading_rad - yaw_before_rad) / vehicle::kIdentifiedStep_s;
    EXPECT_NEAR(measured.yaw_rate_radps, yaw_rate_radps, 0.4) << "one tick apart";
    EXPECT_NEAR(measured.acceleration_left_mps2, motion.speed_mps * measured.yaw_rate_radps, 1e-9);
    yaw_before_rad = motion.pose.heading_rad;
    speed_before_mps = motion.speed_mps;
  }
}

TEST(Plant, NoiseIsUniformWithinItsBoundsAndHasNoBias) {
  Plant plant({.noise_seed = 7});
  double sum_x_m = 0.0;
  double sum_squares_m2 = 0.0;
  double largest_rad = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const Pose pose = plant.measure().pose;
    ASSERT_LE(std::abs(pose.x_m), kPositionNoise_m);
    ASSERT_LE(std::abs(pose.y_m), kPositionNoise_m);
    ASSERT_LE(std::abs(pose.heading_rad), kHeadingNoise_rad);
    sum_x_m += pose.x_m;
    sum_squares_m2 += pose.x_m * pose.x_m;
    largest_rad = std::max(largest_rad, std::abs(pose.heading_rad));
  }
  EXPECT_NEAR(sum_x_m / kDraws, 0.0, 3e-5);
  EXPECT_NEAR(std::sqrt(sum_squares_m2 / kDraws), kPositionNoise_m / std::numbers::sqrt3, 2e-5);
  EXPECT_GT(largest_rad, 0.99 * kHeadingNoise_rad);
}

TEST(Plant, NoiseRepeatsWithItsSeedAndDiffersWithAnother) {
  Plant a({.noise_seed = 7});
  Plant b({.noise_seed = 7});
  Plant c({.noise_seed = 8});
  for (int i = 0; i < 10; ++i) {
    const Pose pose = a.measure().pose;
    EXPECT_EQ(pose, b.measure().pose);
    EXPECT_NE(pose, c.measure().pose);
  }
}

TEST(Plant, NoiseDoesNotMoveTheVehicle) {
  Plant noisy({.noise_seed = 7});
  Plant exact = plant_at_origin();
  for (int i = 0; i < 50; ++i) {
    static_cast<void>(noisy.measure());
    noisy.step({.throttle = 0.3, .steering = 0.2});
    exact.step({.throttle = 0.3, .steering = 0.2});
  }
  EXPECT_EQ(noisy.motion(), exact.motion());
}

TEST(Plant, CopyDrivesOnByItself) {
  Plant plant = plant_at_origin();
  plant.step({.throttle = 1.0});
  Plant copy = plant;
  for (int i = 0; i < 10; ++i) {
    plant.step({.throttle = 1.0});
  }
  EXPECT_EQ(copy.motion(), vehicle::VehicleMotion{});
  for (int i = 0; i < 10; ++i) {
    copy.step({.throttle = 1.0});
  }
  EXPECT_EQ(copy.motion(), plant.motion());
}

TEST(Plant, StartPoseThatIsNotFiniteIsRefused) {
  EXPECT_THROW(Plant({.start = {.x_m = kNan}}), std::invalid_argument);
  EXPECT_THROW(Plant({.start = {.y_m = kInfinity}}), std::invalid_argument);
  EXPECT_THROW(Plant({.start = {.heading_rad = -kInfinity}}), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::plant
