// Where a plan would end askew in its lane, one that ends nearer is searched.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "planner/rollout/rollout.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout::nearer_end_test {
namespace {

/// With the twelve trims of the paper, of which none turns its wheels in place.
const scenario::Scenario& few_trims() {
  static const scenario::Scenario kScenario = test::changed_scenario(
      "lab_cars", "", {{"ucar_traffic_49", "paper"}, {"subgraph: J2", "subgraph: B"}},
      {.cars = 10, .seed = 1});
  return kScenario;
}

Rollout alone_from(VehicleId vehicle, const Pose& start) {
  static const controller::PreparedSubgraph kPrepared = scenario::prepare_subgraph_of(few_trims());
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  controllers.push_back(scenario::make_controller(few_trims(), vehicle, kPrepared));
  return {std::move(controllers), {start}};
}

/// How far the car gets in 10 s.
double led_m(Rollout rollout, const Pose& start) {
  for (int k = 0; k < 50; ++k) static_cast<void>(rollout.step());
  const Pose& end = rollout.controllers().front()->plan_in_force().pose_at(rollout.next_step());
  return (end.position_m() - start.position_m()).norm();
}

/// A car came to stand here among ten, and stayed for 300 s: every plan found ended askew.
constexpr VehicleId kAskew{9};
constexpr Pose kAskewPose{3.919, 1.794, -0.419};

TEST(NearerEnd, LetsACarOutOfABendFromWhichEachPlanWouldEndAskew) {
  EXPECT_GT(led_m(alone_from(kAskew, kAskewPose), kAskewPose), 0.5);
}

TEST(NearerEnd, IsFoundAgainAfterTheStep) {
  Rollout rollout = alone_from(kAskew, kAskewPose);
  ASSERT_EQ(rollout.step().front().status, coordination::StepStatus::kPlanned);
  const controller::Controller& car = *rollout.controllers().front();
  ASSERT_GT(car.problems().size(), 1U) << "no nearer end was searched";
  const controller::PlanWithout again = car.plan_without({});
  ASSERT_TRUE(again.plan);
  EXPECT_EQ(again.plan->pose_at(again.plan->end()),
            car.plan_in_force().pose_at(car.plan_in_force().end()));
}

// Without a search of nearer ends 33 of these 300 stay where they are.
TEST(NearerEnd, LetsCarsDriveOffFromWhereverTheyStandAskew) {
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(300); ++seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double from, double to) {
      return std::uniform_real_distribution(from, to)(random);
    };
    const VehicleId vehicle{static_cast<std::uint8_t>(1 + random() % 10)};
    const scenario::ScenarioVehicle& car = scenario::vehicle_of(few_trims(), vehicle);
    const double s_m = uniform(0.0, car.path.length_m());
    const Point place_m = car.path.at(s_m);
    const double turned_rad = uniform(-0.3, 0.3);
    const Pose start{place_m.x(), place_m.y(), car.path.heading_rad_at(s_m) + turned_rad};
    EXPECT_GT(led_m(alone_from(vehicle, start), start), 0.1) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hlc::rollout::nearer_end_test
