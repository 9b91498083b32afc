// What if a car had taken another route from a step on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>

#include "hlc_bridge/result/first_difference.hpp"
#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/vehicle_sim/closed_loop/forked_scenarios.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"
#include "vehicle_sim/closed_loop/fork.hpp"

namespace hlc::closed_loop::fork_route_test {
namespace {

constexpr std::uint64_t kSteps = 90;

Experiment drive(const scenario::Scenario& scenario, std::vector<Fork> forks,
                 std::uint64_t steps = kSteps) {
  Experiment experiment = drive_experiment(scenario, {.steps = steps, .forks = std::move(forks)});
  EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  return experiment;
}

std::vector<result::StepRecord> rows_of(const Experiment& run) {
  return result::step_records(run.reports, run.drives, run.facts);
}

const Experiment& as_it_was(const scenario::Scenario& scenario) {
  static std::map<const scenario::Scenario*, Experiment> runs;
  const auto known = runs.find(&scenario);
  return known != runs.end() ? known->second : runs[&scenario] = drive(scenario, {});
}

Pose planned_pose(const Experiment& run, VehicleId vehicle, std::uint64_t step) {
  for (const result::StepRecord& row : rows_of(run)) {
    if (row.step == step && row.record.report.vehicle == vehicle) {
      return row.record.report.planned_pose;
    }
  }
  throw std::logic_error("no such step");
}

double distance_m(const road::ReferencePath& path, const Pose& pose) {
  return (path.at(path.project(pose.position_m()).s_m) - pose.position_m()).norm();
}

const road::DrivableRoute& route(const scenario::Scenario& scenario, const std::string& name) {
  return *std::ranges::find(scenario.routes, name, &road::DrivableRoute::name);
}

/// The first step in which the vehicle is in the middle of a lane that the route has, too.
std::uint64_t first_step_on(const scenario::Scenario& scenario, VehicleId vehicle,
                            const road::DrivableRoute& on) {
  const Footprint& footprint = scenario.subgraph->automaton().vehicle.footprint;
  std::uint64_t step = 0;
  for (;; ++step) {
    const Pose pose = planned_pose(as_it_was(scenario), vehicle, step);
    const road::Placement placement = road::placement_on(on, pose, footprint);
    if (road::fits(placement, on) && placement.distance_m < 0.01) return step;
  }
}

bool any_overlap(const Experiment& run, const Footprint& footprint) {
  for (const auto& [one, drive] : run.drives) {
    for (const auto& [other, of_other] : run.drives) {
      if (other <= one) continue;
      for (std::size_t i = 0; i < std::min(drive.size(), of_other.size()); ++i) {
        if (intersects(footprint_area(footprint, drive[i].pose),
                       footprint_area(footprint, of_other[i].pose))) {
          return true;
        }
      }
    }
  }
  return false;
}

TEST(ForkRoute, ACarDrivesOnAlongItFromThatStepOn) {
  const road::DrivableRoute& blue = route(three_cars(), "blue");
  const road::DrivableRoute& red = route(three_cars(), "red");
  const std::uint64_t from = first_step_on(three_cars(), {1}, blue);
  const Experiment run = drive(
      three_cars(), {{.from = from, .changes = {Fork::Route{.vehicle = {1}, .name = "blue"}}}});
  double from_blue_m = 0.0;
  double from_red_m = 0.0;
  for (std::uint64_t step = from; step < kSteps; ++step) {
    const Pose pose = planned_pose(run, {1}, step);
    from_blue_m = std::max(from_blue_m, distance_m(blue.path, pose));
    from_red_m = std::max(from_red_m, distance_m(red.path, pose));
  }
  EXPECT_LT(from_blue_m, 0.1);
  EXPECT_GT(from_red_m, 0.3);
  const auto difference = result::first_difference(rows_of(as_it_was(three_cars())), rows_of(run));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->step, from);
}

TEST(ForkRoute, ThatTheCarDoesNotFitThereIsRefusedNamingWhereItIs) {
  try {
    drive(three_cars(), {{.from = 2, .changes = {Fork::Route{.vehicle = {1}, .name = "blue"}}}});
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("route=1:blue from step 2, must be a route that "
                                                 "vehicle 1 fits there: it is "));
    EXPECT_EQ(std::ranges::count(std::string(error.what()), '\n'), 0);
  }
}

TEST(ForkRoute, ToItsOwnRouteDrivesTheSame) {
  EXPECT_EQ(
      result::trace_sha256(rows_of(drive(
          three_cars(), {{.from = 30, .changes = {Fork::Route{.vehicle = {1}, .name = "red"}}}}))),
      result::trace_sha256(rows_of(as_it_was(three_cars()))));
}

// The vehicles' replicas of the car follow its former route: nobody plans with them.
TEST(ForkRoute, InTwoRoundsIsThatOfSequentialSteps) {
  scenario::Scenario two_rounds = three_cars();
  two_rounds.rounds = controller::Rounds::kTwo;
  const std::uint64_t from = first_step_on(three_cars(), {1}, route(three_cars(), "blue"));
  const std::vector<Fork> forks{
      {.from = from, .changes = {Fork::Route{.vehicle = {1}, .name = "blue"}}}};
  EXPECT_EQ(result::trace_sha256(rows_of(drive(two_rounds, forks))),
            result::trace_sha256(rows_of(drive(three_cars(), forks))));
}

TEST(ForkRoute, WithRightOfWayACarClaimsCellsOfItsNewRoute) {
  const scenario::Scenario& scenario = cars_with_right_of_way();
  const scenario::ScenarioVehicle& car = scenario.vehicles.front();
  const auto other = std::ranges::find_if(scenario.routes, [&](const road::DrivableRoute& one) {
    const Footprint& footprint = scenario.subgraph->automaton().vehicle.footprint;
    const Pose pose = planned_pose(as_it_was(scenario), car.id, 20);
    return one.number != car.route_number &&
           road::fits(road::placement_on(one, pose, footprint), one);
  });
  ASSERT_NE(other, scenario.routes.end());
  std::map<std::uint64_t, std::uint32_t> claimed;
  ExperimentOptions options{
      .steps = kSteps,
      .forks = {{.from = 20, .changes = {Fork::Route{.vehicle = car.id, .name = other->name}}}}};
  options.rules.on_traffic = [&](const controller::Controller&,
                                 const coordination::Traffic& traffic) {
    if (traffic.vehicle == car.id) claimed[traffic.step.value] = traffic.claim.value().route;
  };
  const Experiment run = drive_experiment(scenario, options);
  const std::uint64_t from = run.facts.first_step.value() + 20;
  EXPECT_EQ(claimed.at(from - 1), car.route_number);
  EXPECT_EQ(claimed.at(from), other->number);
}

struct RouteFork {
  std::uint64_t from = 0;
  Fork::Route change;
};

RouteFork random_route_fork(const scenario::Scenario& scenario, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::uint64_t from = random() % 60;
  const VehicleId vehicle = scenario.vehicles[random() % scenario.vehicles.size()].id;
  return {.from = from,
          .change = {.vehicle = vehicle,
                     .name = scenario.routes[random() % scenario.routes.size()].name}};
}

/// None where the car does not fit the route.
std::optional<Experiment> drive_if_it_fits(const scenario::Scenario& scenario,
                                           const RouteFork& fork) {
  try {
    return drive(scenario, {{.from = fork.from, .changes = {fork.change}}});
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("must be a route that vehicle"));
    return std::nullopt;
  }
}

TEST(ForkRoute, AtRandomCarsNeverMeetAndTheRunBeforeIsTheSame) {
  constexpr std::uint64_t kSeedsPerFork = 20;
  const std::uint64_t num_forks = test::num_costly_seeds(5);
  for (const scenario::Scenario* scenario : {&three_cars(), &cars_with_right_of_way()}) {
    std::uint64_t driven = 0;
    for (std::uint64_t seed = 0; driven < num_forks; ++seed) {
      ASSERT_LT(seed, kSeedsPerFork * num_forks) << scenario->name << ": cars fit too few routes";
      SCOPED_TRACE(testing::Message() << scenario->name << ", seed " << seed);
      const RouteFork fork = random_route_fork(*scenario, seed);
      const std::optional<Experiment> run = drive_if_it_fits(*scenario, fork);
      if (!run) continue;
      ++driven;
      EXPECT_FALSE(any_overlap(*run, scenario->subgraph->automaton().vehicle.footprint));
      const auto difference =
          result::first_difference(rows_of(as_it_was(*scenario)), rows_of(*run));
      EXPECT_TRUE(!difference || difference->step >= fork.from);
    }
  }
}

}  // namespace
}  // namespace hlc::closed_loop::fork_route_test
