// Plants made from the limits of a vehicle without identification.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/controller/replaced_plans.hpp"
#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/plant/plant.hpp"

namespace hlc::plant::own_vehicle_test {
namespace {

struct OwnVehicle {
  vehicle::VehicleParameters parameters;
  vehicle::VehicleLimits limits;
};

/// From a model car to a van.
OwnVehicle drawn(std::mt19937_64& random) {
  const auto within = [&](double min, double max) {
    return std::uniform_real_distribution<double>(min, max)(random);
  };
  OwnVehicle one;
  one.parameters.wheelbase_m = within(0.1, 4.0);
  one.parameters.rear_axle_to_cg_m = within(0.2, 0.8) * one.parameters.wheelbase_m;
  one.limits.acceleration_mps2 = within(1.0, 12.0);
  one.limits.steering_rate_radps = within(0.2, 4.0);
  one.limits.steering_max_rad = within(0.2, 1.0);
  return one;
}

Plant plant_of(const OwnVehicle& one) {
  return Plant({.vehicle = vehicle::kinematic_vehicle(one.parameters, one.limits)});
}

TEST(OwnVehicle, KeepsItsLimitsWhateverIsCommanded) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(200); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const OwnVehicle one = drawn(random);
    const double tick_s = vehicle::kIdentifiedStep_s;
    const double curvature_max =
        vehicle::curvature_per_m(one.limits.steering_max_rad, one.parameters);
    const double most_per_tick =
        curvature_max * one.limits.steering_rate_radps / one.limits.steering_max_rad * tick_s;
    Plant plant = plant_of(one);
    std::uniform_real_distribution<double> command(-2.0, 2.0);
    double last_curvature = 0.0;  // of the tick before
    bool stood = true;
    for (int tick = 0; tick < 300; ++tick) {
      const vehicle::VehicleMotion before = plant.motion();
      plant.step({.throttle = command(random), .steering = command(random)});
      const vehicle::VehicleMotion after = plant.motion();
      ASSERT_LE(std::abs(after.speed_mps - before.speed_mps),
                one.limits.acceleration_mps2 * tick_s * (1.0 + 1e-9));
      if (std::abs(before.speed_mps) < 0.01) {
        stood = true;
        continue;
      }
      const double curvature =
          (after.pose.heading_rad - before.pose.heading_rad) / (before.speed_mps * tick_s);
      ASSERT_LE(std::abs(curvature), curvature_max * (1.0 + 1e-6));
      if (!stood) {
        ASSERT_LE(std::abs(curvature - last_curvature), most_per_tick * (1.0 + 1e-6));
      }
      last_curvature = curvature;
      stood = false;
    }
  }
}

/// At full steering the model is exact: the circle is that of the single-track model.
TEST(OwnVehicle, DrivesTheSingleTrackModelsCircleAtFullSteering) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(100); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const OwnVehicle one = drawn(random);
    Plant plant = plant_of(one);
    for (int tick = 0; tick < 500; ++tick) plant.step({.steering = 1.0});
    const double wanted_mps = 0.5 * one.parameters.wheelbase_m;
    while (plant.motion().speed_mps < wanted_mps) plant.step({.throttle = 0.02, .steering = 1.0});
    for (int tick = 0; tick < 10; ++tick) plant.step({.steering = 1.0});
    const vehicle::VehicleMotion from = plant.motion();
    plant.step({.steering = 1.0});
    const vehicle::VehicleMotion to = plant.motion();
    const double turned_rad = to.pose.heading_rad - from.pose.heading_rad;
    const double side_m = (to.pose.position_m() - from.pose.position_m()).norm();
    const double curvature = vehicle::curvature_per_m(one.limits.steering_max_rad, one.parameters);
    EXPECT_NEAR(turned_rad / side_m, curvature, 1e-9 * curvature);
    const Point moved = to.pose.position_m() - from.pose.position_m();
    const double slip_rad = wrap_angle(std::atan2(moved.y(), moved.x()) - from.pose.heading_rad);
    EXPECT_NEAR(slip_rad, vehicle::slip_angle_rad(one.limits.steering_max_rad, one.parameters),
                1e-9);
  }
}

/// Others keep clear of this area where a vehicle may have dropped its command.
TEST(OwnVehicle, ThatDropsItsCommandInACurveStaysInItsBrakingArea) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(200); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const OwnVehicle one = drawn(random);
    automaton::UniversalAutomaton automaton{.vehicle = one.parameters, .limits = one.limits};
    automaton.vehicle.footprint = {1.5 * one.parameters.wheelbase_m,
                                   0.7 * one.parameters.wheelbase_m};
    automaton.vehicle.safety_margin_m = 0.001;
    automaton.identified = vehicle::kinematic_vehicle(one.parameters, one.limits);
    const double steering = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    Plant plant = plant_of(one);
    for (int tick = 0; tick < 500; ++tick) plant.step({.steering = steering});
    const double wanted_mps = std::uniform_real_distribution<double>(0.5, 8.0)(random);
    for (int tick = 0; plant.motion().speed_mps < wanted_mps; ++tick) {
      plant.step({.throttle = 0.1, .steering = steering});
    }
    for (int tick = 0; tick < 5; ++tick) plant.step({.steering = steering});
    const vehicle::VehicleMotion from = plant.motion();
    const double curvature = automaton.identified.yaw_rate_gain_per_m * steering;
    const ConvexPolygon area = controller::braking_area(
        from.pose, from.speed_mps, vehicle::steering_for_curvature_rad(curvature, one.parameters),
        automaton);
    for (int tick = 0; tick < 2000; ++tick) {
      plant.step(vehicle::stop_input(plant.motion().speed_mps));
      ASSERT_TRUE(contains(area, footprint_area(automaton.vehicle.footprint, plant.motion().pose)))
          << tick;
    }
  }
}

TEST(OwnVehicle, RollsWithoutThrottle) {
  std::mt19937_64 random(1);
  Plant plant = plant_of(drawn(random));
  for (int tick = 0; tick < 20; ++tick) plant.step({.throttle = 0.5});
  for (int tick = 0; tick < 5; ++tick) plant.step({});
  const double speed_mps = plant.motion().speed_mps;
  for (int tick = 0; tick < 100; ++tick) plant.step({});
  EXPECT_EQ(plant.motion().speed_mps, speed_mps);
}

}  // namespace
}  // namespace hlc::plant::own_vehicle_test
