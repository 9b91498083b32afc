// Cars among random obstacles: no plan in force meets an obstacle or another car's plan.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "planner/controller/followed_plan.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout::obstacles_test {
namespace {

constexpr std::size_t kSteps = 50;

scenario::Scenario read(std::size_t cars) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml", .cars = cars});
}

/// Where nobody starts, within the circle of the cars.
std::vector<scenario::ScenarioObstacle> random_obstacles(const scenario::Scenario& scenario,
                                                         std::mt19937_64& random) {
  std::uniform_real_distribution<double> place_m(-1.4, 1.4);
  std::uniform_real_distribution<double> heading_rad(-3.0, 3.0);
  std::uniform_real_distribution<double> size_m(0.05, 0.5);
  scenario::Scenario with = scenario;
  const std::size_t count = 1 + random() % 8;
  while (with.obstacles.size() < count) {
    const Pose middle{2.25 + place_m(random), 2.0 + place_m(random), heading_rad(random)};
    with.obstacles.push_back(
        {.name = "", .area_m = footprint_area({size_m(random), size_m(random)}, middle)});
    if (scenario::start_in_obstacle(with)) with.obstacles.pop_back();
  }
  return with.obstacles;
}

/// What the plan sweeps from the step on, and where it stands at its end.
std::vector<ConvexPolygon> areas_of(const coordination::Plan& plan, StepIndex from) {
  const coordination::OccupiedAreas areas = plan.areas_from(from);
  std::vector<ConvexPolygon> areas_m(areas.areas_m.begin(), areas.areas_m.end());
  areas_m.push_back(areas.final_area_m);
  return areas_m;
}

void expect_clear(const Rollout& rollout, const scenario::Scenario& scenario) {
  const vehicle::VehicleParameters& vehicle = scenario.subgraph->automaton().vehicle;
  std::vector<ConvexPolygon> cars_m;
  for (const auto& controller : rollout.controllers()) {
    const coordination::Plan& plan = controller->plan_in_force();
    for (const ConvexPolygon& area_m : areas_of(plan, rollout.next_step())) {
      for (const scenario::ScenarioObstacle& one : scenario.obstacles) {
        EXPECT_FALSE(intersects(area_m, one.area_m))
            << "vehicle " << int{controller->options().vehicle.value};
      }
    }
    cars_m.push_back(footprint_area(vehicle.footprint, plan.pose_at(rollout.next_step())));
    for (std::size_t i = 0; i + 1 < cars_m.size(); ++i) {
      EXPECT_FALSE(intersects(cars_m[i], cars_m.back())) << i;
    }
  }
}

TEST(CarsAmongObstacles, NeverMeetOneNorEachOther) {
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(30); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    scenario::Scenario scenario = read(1 + random() % 5);
    scenario.rounds = seed % 3 == 0 ? controller::Rounds::kTwo : controller::Rounds::kSequential;
    scenario.obstacles = random_obstacles(scenario, random);
    Rollout rollout = make_rollout(scenario);
    rollout.exchange_in(scenario.rounds);
    for (std::size_t k = 0; k < kSteps; ++k) {
      static_cast<void>(rollout.step());
      expect_clear(rollout, scenario);
    }
    if (HasFailure()) return;
  }
}

TEST(CarsAmongObstacles, ACarBeforeAWallStandsAndWaitsForNobody) {
  scenario::Scenario scenario = read(1);
  scenario.obstacles = {{.name = "wall", .area_m = footprint_area({0.1, 9.0}, {2.25, 2.0, 0.0})}};
  Rollout rollout = make_rollout(scenario);
  coordination::Report last;
  for (std::size_t k = 0; k < kSteps; ++k) {
    last = rollout.step().front();
    rollout.controllers().front()->note_causes(last);
  }
  EXPECT_TRUE(last.waiting.vehicles.empty());
  EXPECT_GT(last.planned_pose.x_m, 2.25);
  EXPECT_LT(last.planned_pose.x_m, 2.75) << "it stands before the wall";
  EXPECT_EQ(rollout.step().front().planned_pose, last.planned_pose);
}

}  // namespace
}  // namespace hlc::rollout::obstacles_test
