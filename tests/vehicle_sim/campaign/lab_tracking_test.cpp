// How well the simulated vehicle follows our commands in the lab's scenarios: its dynamics, its
// sensors' noise, subgraph B at the speeds of the trims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>

#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/support/folders.hpp"
#include "tests/vehicle_sim/vehicle/closed_loop.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::campaign::lab_tracking_test {
namespace {

constexpr Nanoseconds kLabLead = kVehiclePeriod;  // Stamps::kLab
constexpr double kMean_m = 0.010;
constexpr double kMax_m = 0.020;
/// What the lab's own vehicles reach at least and at most (wire contract, 9), per scenario.
constexpr double kLabMostMean_m = 0.005;
constexpr double kLabLeastMax_m = 0.010;
constexpr double kLabMostMax_m = 0.034;
constexpr double kLeastDistance_m = 0.020;

/// Errors of all cars at stamp + lead, or at the stamp, where the lab's measurements compare them.
std::vector<double> errors_m(const closed_loop::Experiment& experiment,
                             const scenario::Scenario& scenario, Nanoseconds lead) {
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  std::vector<double> errors_m;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    std::vector<result::StepRecord> rows;
    for (const result::StepRecord& row :
         result::step_records(experiment.reports, experiment.drives, experiment.facts)) {
      if (row.record.report.vehicle == vehicle.id) rows.push_back(row);
    }
    std::vector<const result::StepRecord*> own;
    for (const result::StepRecord& row : rows) own.push_back(&row);
    const std::vector<vehicle::State> planned =
        result::planned_motion(own, experiment.facts.period, kVehiclePeriod, automaton);
    const Nanoseconds begin = *experiment.facts.first_step * experiment.facts.period;
    const std::vector<vehicle::State> driven =
        result::driven_motion(experiment.drives.at(vehicle.id.value), begin + kLabLead - lead,
                              kVehiclePeriod, planned.size());
    for (std::size_t i = 0; i < driven.size(); ++i) {
      errors_m.push_back((driven[i].pose.position_m() - planned[i].pose.position_m()).norm());
    }
  }
  return errors_m;
}

void print(const std::string& what, std::vector<double> errors_m) {
  const result::Statistics all = result::statistics(errors_m).value();
  const auto p95 = errors_m.begin() + static_cast<std::ptrdiff_t>(errors_m.size() * 95 / 100);
  std::ranges::nth_element(errors_m, p95);
  std::printf("%-24s mean %4.1f, p95 %4.1f, max %4.1f mm\n", what.c_str(), 1e3 * all.mean,
              1e3 * *p95, 1e3 * all.max);
}

void expect_tracked(const std::string& name, std::uint64_t steps) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml"});
  for (const std::optional<std::uint64_t> noise_seed :
       {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1),
        std::optional<std::uint64_t>(1000)}) {
    SCOPED_TRACE(name + (noise_seed ? ", noise seed " + std::to_string(*noise_seed) : ""));
    const closed_loop::Experiment experiment =
        closed_loop::drive_experiment(scenario, {.steps = steps, .noise_seed = noise_seed});
    ASSERT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
    for (const ReportRecord& record : experiment.reports) {
      const coordination::FallbackReason reason = record.report.reason;
      EXPECT_TRUE(reason != coordination::FallbackReason::kDeviation &&
                  reason != coordination::FallbackReason::kConflict &&
                  reason != coordination::FallbackReason::kUndrivable)
          << to_string(reason) << ", vehicle " << int{record.report.vehicle.value} << ", step "
          << record.report.step.value;
    }
    const result::RunSummary summary = result::summarize(
        result::describe(scenario, noise_seed), experiment.facts,
        result::step_records(experiment.reports, experiment.drives, experiment.facts),
        experiment.drives);
    EXPECT_EQ(result::driving_fault(summary), "");
    ASSERT_EQ(summary.min_footprint_distance_m.has_value(), scenario.vehicles.size() > 1);
    EXPECT_GE(summary.min_footprint_distance_m.value_or(kLeastDistance_m), kLeastDistance_m);
    const std::vector<double> at_lead_m = errors_m(experiment, scenario, kLabLead);
    const std::vector<double> at_stamp_m = errors_m(experiment, scenario, 0);
    const result::Statistics all = result::statistics(at_lead_m).value();
    EXPECT_LE(all.mean, kLabMostMean_m);
    EXPECT_GE(all.max, kLabLeastMax_m);
    EXPECT_LE(all.max, kLabMostMax_m);
    EXPECT_LE(all.max, scenario.lab->tracking_error_max_m);
    EXPECT_GT(result::statistics(at_stamp_m).value().mean, 1.5 * all.mean);
    print(name + (noise_seed ? ", noise" : ""), at_lead_m);
    print("  at the stamp alone", at_stamp_m);
  }
}

TEST(LabTracking, TheRedCarAloneKeepsToItsCommands) { expect_tracked("lab_red_alone", 150); }

TEST(LabTracking, TheCarsOfTheRedRouteAndThoseItMeetsKeepToTheirCommands) {
  expect_tracked("lab_three_cars", 150);
}

TEST(LabTracking, TheCarsOnTheRingKeepToTheirCommands) { expect_tracked("lab_ring", 150); }

TEST(LabTracking, TheCarsOnTheCircleKeepToTheirCommands) { expect_tracked("lab_circle", 75); }

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

const Pose kCircleStart{1.0, 0.0, 0.5 * std::numbers::pi};

// Measured with the lab's own vehicle and controller (wire contract, 6.3).
TEST(LabTracking, TheLabsVehicleDrivesTheRadiiThatWereMeasured) {
  const auto radii_m = [](Nanoseconds interval) {
    simulated_vehicle::SimulatedVehicle vehicle(
        {.vehicle_id = 1, .start = kCircleStart, .stamps = simulated_vehicle::Stamps::kLab});
    std::pair<double, double> range{2.0, 0.0};
    for (const auto& sample : simulated_vehicle::driven_vehicle::drive(
             vehicle, circle(1.0, interval * simulated_vehicle::driven_vehicle::kMillisecond),
             30'000 * simulated_vehicle::driven_vehicle::kMillisecond)) {
      if (sample.t < 5'000 * simulated_vehicle::driven_vehicle::kMillisecond) continue;
      const double radius_m = sample.tick.driven.pose.position_m().norm();
      range = {std::min(range.first, radius_m), std::max(range.second, radius_m)};
    }
    return range;
  };
  // Without the measurement's noise the range is one radius.
  const auto [least_100_m, most_100_m] = radii_m(100);
  EXPECT_GE(least_100_m, 0.995);
  EXPECT_LE(most_100_m, 0.999);
  const auto [least_200_m, most_200_m] = radii_m(200);
  EXPECT_GE(least_200_m, 0.994);
  EXPECT_LE(most_200_m, 1.005);
}

TEST(LabTracking, TheLabsCircleIsKeptToAtEveryTrimsSpeed) {
  for (const double speed_mps : {0.4, 0.5, 0.6, 0.7, 0.8}) {
    for (const std::optional<std::uint64_t> noise_seed :
         {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1)}) {
      simulated_vehicle::SimulatedVehicle vehicle(
          {.vehicle_id = 1, .start = kCircleStart, .noise_seed = noise_seed});
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
