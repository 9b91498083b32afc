// What if something stood on the road from a step on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/vehicle_sim/closed_loop/forked_scenarios.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"
#include "vehicle_sim/closed_loop/fork.hpp"

namespace hlc::closed_loop::fork_obstacle_test {
namespace {

constexpr std::uint64_t kSteps = 60;
constexpr std::uint64_t kFrom = 10;

Experiment drive(const scenario::Scenario& scenario, std::vector<Fork::Change> changes = {}) {
  Experiment experiment = drive_experiment(
      scenario, {.steps = kSteps, .forks = {{.from = kFrom, .changes = std::move(changes)}}});
  EXPECT_EQ(experiment.facts.exit_code, 0) << experiment.facts.reason;
  return experiment;
}

ConvexPolygon area_of(const Fork::Obstacle& obstacle) {
  return footprint_area({obstacle.length_m, obstacle.width_m}, obstacle.pose);
}

/// Time of the fork's first step.
Nanoseconds start_of_fork(const Experiment& run) {
  return run.facts.period * static_cast<Nanoseconds>(run.facts.first_step.value() + kFrom);
}

/// Whether a vehicle touches the area at any time since the fork.
bool is_touched(const ConvexPolygon& area_m, const Experiment& run, const Footprint& footprint) {
  return std::ranges::any_of(run.drives, [&](const auto& drive) {
    return std::ranges::any_of(drive.second, [&](const result::DrivenSample& sample) {
      return sample.t >= start_of_fork(run) &&
             intersects(area_m, footprint_area(footprint, sample.pose));
    });
  });
}

/// Something on the way of a car.
Fork::Obstacle random_obstacle(const scenario::Scenario& scenario, std::mt19937_64& random) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution(least, most)(random);
  };
  const scenario::ScenarioVehicle& car = scenario.vehicles[random() % scenario.vehicles.size()];
  const Point at_m = car.path.at(car.start_s_m + between(0.3, 5.0));
  return {
      .pose = {at_m.x() + between(-0.1, 0.1), at_m.y() + between(-0.1, 0.1), between(-3.0, 3.0)},
      .length_m = between(0.02, 0.4),
      .width_m = between(0.02, 0.2)};
}

/// Across the road 4 m ahead of the first car's start: it cannot pass.
Fork::Obstacle wall() {
  const scenario::ScenarioVehicle& car = three_cars().vehicles.front();
  const double s_m = car.start_s_m + 4.0;
  const Point at_m = car.path.at(s_m);
  return {
      .pose = {at_m.x(), at_m.y(), car.path.heading_rad_at(s_m)}, .length_m = 0.05, .width_m = 0.6};
}

/// No run, if the obstacle stands where a vehicle can no longer stop before it.
std::optional<Experiment> run_with(const scenario::Scenario& scenario,
                                   const Fork::Obstacle& obstacle) {
  try {
    return drive(scenario, {obstacle});
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("must be clear of vehicle"));
    return std::nullopt;
  }
}

class RandomForkObstacle : public testing::TestWithParam<const scenario::Scenario& (*)()> {};

TEST_P(RandomForkObstacle, IsTouchedByNoVehicleAlsoWhereTheyDroveBefore) {
  const scenario::Scenario& scenario = GetParam()();
  const Footprint& footprint = scenario.subgraph->automaton().vehicle.footprint;
  const Experiment as_it_was = drive(scenario);
  int in_the_way = 0;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(12); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Fork::Obstacle obstacle = random_obstacle(scenario, random);
    const ConvexPolygon area_m = area_of(obstacle);
    const std::optional<Experiment> run = run_with(scenario, obstacle);
    if (!run) continue;
    in_the_way += is_touched(area_m, as_it_was, footprint) ? 1 : 0;
    EXPECT_FALSE(is_touched(area_m, *run, footprint));
  }
  EXPECT_GT(in_the_way, 0);
}

INSTANTIATE_TEST_SUITE_P(Fork, RandomForkObstacle,
                         testing::Values(&three_cars, &cars_with_right_of_way));

TEST(ForkObstacle, StopsACarThatCannotPassAndNobodyElseIsBlamed) {
  const VehicleId car = three_cars().vehicles.front().id;
  const Experiment run = drive(three_cars(), {wall()});
  const ReportRecord& last =
      *std::ranges::find_if(run.reports.rbegin(), run.reports.rend(),
                            [&](const ReportRecord& one) { return one.report.vehicle == car; });
  EXPECT_EQ(run.drives.at(car.value).back().speed_mps, 0.0);
  EXPECT_EQ(last.report.status, coordination::StepStatus::kPlanned) << "it plans to stand";
  EXPECT_THAT(last.report.waiting.vehicles, testing::IsEmpty());
}

TEST(ForkObstacle, OnACarOrTooNearToStopIsRefusedNamingIt) {
  const Experiment as_it_was = drive(three_cars());
  const auto refusal = [&](double ahead_m) -> std::string {
    const Pose car =
        result::driven_pose_at(as_it_was.drives.at(2), start_of_fork(as_it_was)).value();
    const Pose pose = compose(car, {ahead_m, 0.0, 0.0});
    try {
      drive(three_cars(), {Fork::Obstacle{.pose = pose, .length_m = 0.02, .width_m = 0.02}});
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  for (const double ahead_m : {0.0, 0.25}) {
    EXPECT_THAT(refusal(ahead_m), testing::HasSubstr("from step 10, must be clear of vehicle 2"));
    EXPECT_EQ(std::ranges::count(refusal(ahead_m), '\n'), 0);
  }
}

TEST(ForkObstacle, NoAuthorityGrowsIntoItWithRightOfWay) {
  const scenario::Scenario& scenario = cars_with_right_of_way();
  const right_of_way::ConflictMap& map = *scenario.conflicts;
  const scenario::ScenarioVehicle& car = scenario.vehicles.front();
  const Point at_m = car.path.at(car.start_s_m + 3.0);
  const Fork::Obstacle obstacle{.pose = {at_m.x(), at_m.y(), 0.0}, .length_m = 0.1, .width_m = 0.1};
  const ConvexPolygon area_m = area_of(obstacle);
  const auto gained_in_it = [&](std::vector<Fork> forks) {
    std::map<VehicleId, std::int64_t> ends;
    int gained = 0;
    ExperimentOptions options{.steps = kSteps, .forks = std::move(forks)};
    options.rules.on_traffic = [&](const controller::Controller&,
                                   const coordination::Traffic& traffic) {
      const coordination::LaneClaim& claim = traffic.claim.value();
      const std::int64_t end = map.count_at(claim.route, claim.place_m + claim.ahead_m);
      const std::int64_t former = std::exchange(ends[traffic.vehicle], end);
      for (std::int64_t cell = former + 1; former > 0 && cell <= end; ++cell) {
        const std::size_t index = map.index_of(claim.route, cell);
        gained += intersects(map.area_m(claim.route, index), area_m) ? 1 : 0;
      }
    };
    static_cast<void>(drive_experiment(scenario, options));
    return gained;
  };
  EXPECT_GT(gained_in_it({}), 0);
  EXPECT_EQ(gained_in_it({{.from = 0, .changes = {obstacle}}}), 0);
}

// The controllers' replicas of the others have to know of it, too.
TEST(ForkObstacle, KeepsTwoRounds) {
  const std::vector<Fork> forks{{.from = kFrom, .changes = {wall()}}};
  scenario::Scenario two_rounds = three_cars();
  two_rounds.rounds = controller::Rounds::kTwo;
  // Without predictions only two rounds have the others' plans.
  ExperimentOptions options{.steps = kSteps, .forks = forks};
  options.rules.is_lost = [](const controller::Delivery& delivery) {
    return delivery.kind == controller::MessageKind::kPrediction;
  };
  const auto trace_of = [](const Experiment& run) {
    return result::trace_sha256(result::step_records(run.reports, run.drives, run.facts));
  };
  EXPECT_EQ(trace_of(drive_experiment(two_rounds, options)),
            trace_of(drive_experiment(three_cars(), {.steps = kSteps, .forks = forks})));
}

}  // namespace
}  // namespace hlc::closed_loop::fork_obstacle_test
