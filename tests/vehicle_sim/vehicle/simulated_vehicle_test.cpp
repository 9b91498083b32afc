#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/vehicle_sim/vehicle/closed_loop.hpp"

namespace hlc::simulated_vehicle::simulated_vehicle_test {
namespace {

using driven_vehicle::drive;
using driven_vehicle::kMillisecond;
using driven_vehicle::Mission;
using driven_vehicle::Sample;
using driven_vehicle::TrimWalk;

const Pose kStart{.x_m = 1.0, .y_m = 2.0, .heading_rad = 0.4};

SimulatedVehicle vehicle_at(const Pose& start) {
  return SimulatedVehicle({.vehicle_id = 7, .start = start});
}

/// 0.8 m/s straight on from t = 1 s, for `moving_steps` steps in the middle.
TrimWalk straight_walk(std::size_t moving_steps) {
  std::vector<std::size_t> trims(moving_steps + 1, 7);
  trims.insert(trims.begin(), 1);
  trims.push_back(1);
  return TrimWalk(kStart, trims, 1);
}

TEST(SimulatedVehicle, StateIsStampedAsInTheLab) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  for (Nanoseconds t = 0; t < 10 * kVehiclePeriod; t += kVehiclePeriod) {
    const VehicleState state = vehicle.tick(t).state;
    EXPECT_EQ(state.vehicle_id, 7);
    EXPECT_EQ(state.create_stamp, t);
    EXPECT_EQ(state.valid_after_stamp, t + 60 * kMillisecond);
    EXPECT_EQ(state.pose, kStart);
    EXPECT_EQ(state.ips_update_age, 0U);
    EXPECT_EQ(state.imu_yaw_rad, kStart.heading_rad);
    EXPECT_EQ(state.speed_mps, 0.0);
    EXPECT_EQ(state.battery_voltage_v, 7.8);
    EXPECT_FALSE(state.is_real);
  }
}

TEST(SimulatedVehicle, WithoutNoiseTheStateIsTheTruthBitForBit) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  const TrimWalk walk(kStart, {1, 7, 8, 9, 10, 11, 10, 9, 8, 7, 6, 5, 4, 3, 1}, 1);
  for (const Sample& sample : drive(vehicle, walk.mission(), walk.end())) {
    EXPECT_EQ(sample.tick.state.pose, sample.tick.driven.pose);
    EXPECT_EQ(sample.tick.state.speed_mps, sample.tick.driven.speed_mps);
  }
}

TEST(SimulatedVehicle, WithTheLabsStampsAStateShowsThePoseOfATickLater) {
  SimulatedVehicle vehicle({.vehicle_id = 7, .start = kStart, .stamps = Stamps::kLab});
  const std::vector<Sample> samples =
      drive(vehicle, straight_walk(10).mission(), straight_walk(10).end());
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const SimulatedVehicle::Tick& tick = samples[i].tick;
    EXPECT_EQ(tick.state.create_stamp, samples[i].t);
    EXPECT_EQ(tick.driven.t, samples[i].t);
    EXPECT_EQ(tick.state.pose, samples[i + 1].tick.driven.pose);
    EXPECT_EQ(tick.observation.pose, samples[i + 1].tick.driven.pose);
    EXPECT_EQ(tick.state.speed_mps, samples[i + 1].tick.driven.speed_mps);
  }
}

TEST(SimulatedVehicle, WithTheLabsStampsItLeavesItsReferenceWhereThatStartsAndStops) {
  SimulatedVehicle vehicle({.vehicle_id = 7, .start = kStart, .stamps = Stamps::kLab});
  const TrimWalk walk = straight_walk(15);
  const Nanoseconds start = TrimWalk::kFirstStep * driven_vehicle::kPeriod;
  const Nanoseconds tail = 1'000 * kMillisecond;
  double at_start_m = 0.0;
  double driving_m = 0.0;
  double at_stop_m = 0.0;
  for (const Sample& sample : drive(vehicle, walk.mission(), walk.end() + tail)) {
    const bool starts = sample.t < start + 5 * driven_vehicle::kPeriod;
    const bool stops = sample.t + driven_vehicle::kPeriod > walk.end();
    double& largest_m = starts ? at_start_m : stops ? at_stop_m : driving_m;
    largest_m = std::max(largest_m, sample.error_m());
  }
  EXPECT_GT(at_start_m, 0.010);
  EXPECT_LT(at_start_m, 0.034);
  EXPECT_LT(driving_m, 0.006);
  EXPECT_GT(at_stop_m, 0.010);
  EXPECT_LT(at_stop_m, 0.034);
}

TEST(SimulatedVehicle, EqualOptionsAndCommandsGiveEqualDrives) {
  const TrimWalk walk(kStart, {1, 7, 8, 9, 10, 9, 8, 7, 1}, 1);
  const SimulatedVehicleOptions options{.vehicle_id = 1, .start = kStart, .noise_seed = 11};
  SimulatedVehicle a(options);
  SimulatedVehicle b(options);
  const std::vector<Sample> drive_a = drive(a, walk.mission(), walk.end());
  const std::vector<Sample> drive_b = drive(b, walk.mission(), walk.end());
  for (std::size_t i = 0; i < drive_a.size(); ++i) {
    ASSERT_EQ(drive_a[i].tick.driven.pose, drive_b[i].tick.driven.pose);
    ASSERT_EQ(drive_a[i].tick.state.pose, drive_b[i].tick.state.pose);
  }
}

TEST(SimulatedVehicle, WithZeroGainsItDoesNotMove) {
  SimulatedVehicle vehicle({.vehicle_id = 1,
                            .start = kStart,
                            .gains = tracking::scaled(tracking::FollowerGains{}, 0.0)});
  const TrimWalk walk = straight_walk(10);
  const std::vector<Sample> samples = drive(vehicle, walk.mission(), walk.end());
  EXPECT_EQ(samples.back().tick.driven.pose, kStart);
  EXPECT_GT(samples.back().error_m(), 1.0);
}

TEST(SimulatedVehicle, OfSeveralKindsOfCommandsTheFirstInTheLabsOrderCounts) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  constexpr Nanoseconds kSecond = 1'000 * kMillisecond;
  const auto at = [](auto command, Nanoseconds stamp) {
    command.create_stamp = command.valid_after_stamp = stamp;
    return command;
  };
  PathTrackingCommand path{.path = {{.pose = {.x_m = -5.0}}, {.pose = {.x_m = 5.0}}},
                           .speed_mps = 0.5};
  for (PathPoint& point : path.path) point.pose.y_m = kStart.y_m;
  vehicle.receive(at(path, 0));
  vehicle.receive(
      at(SpeedCurvatureCommand{.speed_mps = 0.4, .curvature_per_m = 1.0}, 20 * kMillisecond));
  vehicle.receive(
      at(DirectCommand{.motor_throttle = 0.2, .steering_servo = 0.5}, 40 * kMillisecond));
  EXPECT_EQ(vehicle.tick(0).driven.command_create, 0U);
  EXPECT_EQ(vehicle.tick(20 * kMillisecond).driven.steering, 0.241857);
  const SimulatedVehicle::Tick direct = vehicle.tick(40 * kMillisecond);
  EXPECT_EQ(direct.driven.steering, 0.5);
  EXPECT_EQ(direct.driven.throttle, 0.2);
  EXPECT_EQ(direct.driven.command_create, 40 * kMillisecond);
  EXPECT_EQ(direct.status, tracking::FollowerStatus::kFollowing);
  // One after the other runs out after 1 s, the path's first of all: then nothing is left.
  EXPECT_EQ(vehicle.tick(40 * kMillisecond + kSecond).status, tracking::FollowerStatus::kNoCommand);
  vehicle.receive(at(path, 2 * kSecond));
  vehicle.receive(at(SpeedCurvatureCommand{.speed_mps = 0.4}, 2 * kSecond + 500 * kMillisecond));
  EXPECT_GT(vehicle.tick(2 * kSecond).driven.throttle, 0.0);
  EXPECT_EQ(vehicle.tick(3 * kSecond).driven.command_create, 2 * kSecond + 500 * kMillisecond);
  vehicle.brake();
  EXPECT_EQ(vehicle.tick(3 * kSecond + 20 * kMillisecond).status,
            tracking::FollowerStatus::kNoCommand);
}

TEST(SimulatedVehicle, ASpeedAndACurvatureAreDriven) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  SimulatedVehicle::Tick last;
  for (Nanoseconds t = 0; t < 5'000 * kMillisecond; t += kVehiclePeriod) {
    vehicle.receive(SpeedCurvatureCommand{
        .create_stamp = t, .valid_after_stamp = t, .speed_mps = 0.6, .curvature_per_m = 1.0});
    last = vehicle.tick(t);
  }
  EXPECT_NEAR(last.driven.speed_mps, 0.6, 0.02);
  EXPECT_GT(last.driven.pose.heading_rad, 2.0);
}

TEST(SimulatedVehicle, RecordsTheCommandThatItFollows) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  const TrimWalk walk = straight_walk(5);
  for (const Sample& sample : drive(vehicle, walk.mission(), walk.end())) {
    const Nanoseconds want =
        sample.t == 0 ? 0 : (sample.t - 1) / (200 * kMillisecond) * (200 * kMillisecond) + 1;
    EXPECT_EQ(sample.tick.driven.command_create, want) << sample.t;
  }
}

TEST(SimulatedVehicle, DrivesItsLastPlanToTheEndWhenCommandsEnd) {
  // The last command holds a standing end; its second copy keeps it usable.
  SimulatedVehicle vehicle = vehicle_at(kStart);
  const TrimWalk walk = straight_walk(20);
  Mission mission = walk.mission();
  mission.last_step = 12;
  const std::vector<TrajectoryPoint> last_plan = mission.points(mission.last_step);
  const std::vector<Sample> samples = drive(vehicle, mission, 6'000 * kMillisecond);
  const Point end_m(last_plan.back().x_m, last_plan.back().y_m);
  const vehicle::VehicleMotion& motion = vehicle.motion();
  EXPECT_LT((motion.pose.position_m() - end_m).norm(), 0.010);
  EXPECT_NEAR(motion.speed_mps, 0.0, 1e-3);
}

TEST(SimulatedVehicle, StandsHalfASecondAfterTheLastCommandHasExpired) {
  // Commands without a standing end: only the rule of 1 s and the stop law can halt the vehicle.
  SimulatedVehicle vehicle = vehicle_at({});
  const auto endless = [](Nanoseconds t) {  // 4 m/s^2 up to 1 m/s
    const double s = std::max(0.0, 1e-9 * static_cast<double>(t) - 1.0);
    const bool accelerates = s < 0.25;
    return TrajectoryPoint{.t = t,
                           .x_m = accelerates ? 2.0 * s * s : s - 0.125,
                           .vx_mps = accelerates ? 4.0 * s : 1.0};
  };
  constexpr Nanoseconds kLast = 2'600 * kMillisecond + 1;
  for (Nanoseconds t = 0; t < 6'000 * kMillisecond; t += kVehiclePeriod) {
    if (t % (200 * kMillisecond) == 0 && t < kLast) {
      TrajectoryCommand command{.create_stamp = t + 1, .valid_after_stamp = t + 1, .points = {}};
      for (Nanoseconds at = t; at <= t + 4'000 * kMillisecond; at += 50 * kMillisecond) {
        command.points.push_back(endless(at));
      }
      vehicle.receive(command);
    }
    const SimulatedVehicle::Tick tick = vehicle.tick(t);
    if (t < kLast + 1'000 * kMillisecond) {
      EXPECT_EQ(tick.status == tracking::FollowerStatus::kFollowing, t > 0) << t;
    } else {
      EXPECT_EQ(tick.status, tracking::FollowerStatus::kNoCommand) << t;
    }
    if (t == 3'500 * kMillisecond) {
      EXPECT_NEAR(tick.driven.speed_mps, 1.0, 0.02) << "still driving";
    }
    if (t > kLast + 1'500 * kMillisecond) {
      EXPECT_LT(std::abs(tick.driven.speed_mps), 0.05) << t;
    }
  }
}

TEST(SimulatedVehicle, AfterTheStopItBrakesForFiftyTicksAndForgetsItsCommands) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  const TrimWalk walk = straight_walk(40);
  const Mission mission = walk.mission();
  const Nanoseconds stop = 3'000 * kMillisecond;
  static_cast<void>(drive(vehicle, mission, stop));
  ASSERT_NEAR(vehicle.motion().speed_mps, 0.8, 0.02);
  vehicle.brake();
  // Commands that go on meanwhile have no effect, not even after the braking.
  const Nanoseconds braked = stop + 50 * kVehiclePeriod;
  for (Nanoseconds t = stop; t < braked; t += kVehiclePeriod) {
    ASSERT_TRUE(vehicle.is_braking()) << t;
    for (const Sample& sample : drive(vehicle, mission, t + kVehiclePeriod, t)) {
      EXPECT_EQ(sample.tick.status, tracking::FollowerStatus::kNoCommand);
    }
  }
  EXPECT_FALSE(vehicle.is_braking());
  EXPECT_NEAR(vehicle.motion().speed_mps, 0.0, 0.02);
  EXPECT_EQ(vehicle.tick(braked).status, tracking::FollowerStatus::kNoCommand);
  // Then it listens again.
  Nanoseconds t = braked + kVehiclePeriod;
  const Pose pose = vehicle.motion().pose;
  vehicle.receive(TrajectoryCommand{
      .create_stamp = t,
      .valid_after_stamp = t,
      .points = {{.t = t, .x_m = pose.x_m, .y_m = pose.y_m},
                 {.t = t + 2'000 * kMillisecond, .x_m = pose.x_m, .y_m = pose.y_m}}});
  EXPECT_EQ(vehicle.tick(t).status, tracking::FollowerStatus::kFollowing);
}

TEST(SimulatedVehicle, GarbageOnTheWireNeverMovesIt) {
  SimulatedVehicle vehicle = vehicle_at(kStart);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (Nanoseconds t = 0; t < 2'000 * kMillisecond; t += kVehiclePeriod) {
    TrajectoryCommand command{.create_stamp = t, .valid_after_stamp = t, .points = {}};
    for (Nanoseconds at = 0; at <= 1'000 * kMillisecond; at += 100 * kMillisecond) {
      command.points.push_back({.t = t + at, .x_m = 1.0, .y_m = 2.0, .vx_mps = 0.5});
    }
    switch (t / kVehiclePeriod % 4) {
      case 0:
        command.points[5].x_m = kNan;
        break;
      case 1:
        std::swap(command.points[4], command.points[5]);
        break;
      case 2:
        command.points.clear();
        break;
      default:
        for (TrajectoryPoint& point : command.points) {
          point.x_m += 10.0;
        }
    }
    vehicle.receive(command);
    const SimulatedVehicle::Tick tick = vehicle.tick(t);
    EXPECT_NE(tick.status, tracking::FollowerStatus::kFollowing);
    EXPECT_EQ(tick.driven.pose, kStart);
  }
}

}  // namespace
}  // namespace hlc::simulated_vehicle::simulated_vehicle_test
