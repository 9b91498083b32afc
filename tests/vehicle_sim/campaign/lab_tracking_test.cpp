// How well the simulated vehicle follows our commands in the lab's scenarios: its dynamics, its
// sensors' noise, subgraph B at the speeds of the trims.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/support/folders.hpp"
#include "tests/vehicle_sim/vehicle/closed_loop.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::campaign::lab_tracking_test {
namespace {

constexpr double kMean_m = 0.010;
constexpr double kMax_m = 0.020;

result::RunSummary driven(const std::string& name, std::uint64_t steps,
                          std::optional<std::uint64_t> noise_seed) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml"});
  const closed_loop::Experiment experiment =
      closed_loop::drive_experiment(scenario, {.steps = steps, .noise_seed = noise_seed});
  EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  const std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, experiment.facts);
  return result::summarize(result::describe(scenario, noise_seed), experiment.facts, rows,
                           experiment.drives);
}

void expect_tracked(const std::string& name, std::uint64_t steps) {
  for (const std::optional<std::uint64_t> noise_seed :
       {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1),
        std::optional<std::uint64_t>(1000)}) {
    SCOPED_TRACE(name + (noise_seed ? ", noise seed " + std::to_string(*noise_seed) : ""));
    const result::RunSummary summary = driven(name, steps, noise_seed);
    EXPECT_EQ(summary.collisions, 0U);
    for (const result::VehicleSummary& vehicle : summary.vehicles) {
      ASSERT_TRUE(vehicle.tracking_error_m);
      EXPECT_LE(vehicle.tracking_error_m->mean, kMean_m) << vehicle.name;
      EXPECT_LE(vehicle.tracking_error_m->max, kMax_m) << vehicle.name;
      EXPECT_EQ(vehicle.undrivable_steps, 0U) << vehicle.name;
      EXPECT_EQ(vehicle.steps_outside_announced_area, 0U) << vehicle.name;
      std::cout << name << (noise_seed ? ", noise" : "") << ": " << vehicle.name << " mean "
                << 1e3 * vehicle.tracking_error_m->mean << " mm, max "
                << 1e3 * vehicle.tracking_error_m->max << " mm, fallback steps "
                << vehicle.fallback_steps << '\n';
    }
  }
}

TEST(LabTracking, TheCarsOfTheRedRouteAndThoseItMeetsKeepToTheirCommands) {
  expect_tracked("lab_three_cars", 150);
}

TEST(LabTracking, TheCarsOnTheCircleKeepToTheirCommands) { expect_tracked("lab_circle", 60); }

/// The lab's circle of 1 m, at a trim's speed, points as our commands have them.
simulated_vehicle::driven_vehicle::Mission circle(double speed_mps, Nanoseconds interval) {
  const auto at = [speed_mps](Nanoseconds t) {
    const double angle =
        speed_mps * std::max(0.0, 1e-9 * static_cast<double>(t) - 1.0);  // stands for 1 s
    return TrajectoryPoint{.t = t,
                           .x_m = std::cos(angle),
                           .y_m = std::sin(angle),
                           .vx_mps = angle > 0.0 ? -speed_mps * std::sin(angle) : 0.0,
                           .vy_mps = angle > 0.0 ? speed_mps * std::cos(angle) : 0.0};
  };
  return {.points =
              [at, interval](std::uint64_t step) {
                const Nanoseconds begin = step * simulated_vehicle::driven_vehicle::kPeriod;
                std::vector<TrajectoryPoint> points;
                for (Nanoseconds t = begin < interval ? 0 : begin - interval;
                     t <= begin + 2'200 * simulated_vehicle::driven_vehicle::kMillisecond;
                     t += interval) {
                  points.push_back(at(t));
                }
                return points;
              },
          .planned = [at](Nanoseconds t) { return Point(at(t).x_m, at(t).y_m); },
          .last_step = ~std::uint64_t{0}};
}

TEST(LabTracking, TheLabsCircleIsKeptToAtEveryTrimsSpeed) {
  for (const double speed_mps : {0.4, 0.5, 0.6, 0.7, 0.8}) {
    for (const std::optional<std::uint64_t> noise_seed :
         {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1)}) {
      simulated_vehicle::SimulatedVehicle vehicle({.vehicle_id = 1,
                                                   .start = {1.0, 0.0, 0.5 * std::numbers::pi},
                                                   .noise_seed = noise_seed,
                                                   .gains = {},
                                                   .vehicle = {}});
      const auto samples = simulated_vehicle::driven_vehicle::drive(
          vehicle, circle(speed_mps, 25 * simulated_vehicle::driven_vehicle::kMillisecond),
          30'000 * simulated_vehicle::driven_vehicle::kMillisecond);
      const simulated_vehicle::driven_vehicle::TrackingError error =
          simulated_vehicle::driven_vehicle::tracking_error(
              samples, 2'000 * simulated_vehicle::driven_vehicle::kMillisecond);
      EXPECT_LE(error.mean_m, kMean_m) << speed_mps;
      EXPECT_LE(error.max_m, kMax_m) << speed_mps;
      std::cout << "circle at " << speed_mps << " m/s" << (noise_seed ? ", noise" : "") << ": "
                << simulated_vehicle::driven_vehicle::to_string(error) << '\n';
    }
  }
}

}  // namespace
}  // namespace hlc::campaign::lab_tracking_test
