// Cars with reference speeds of their own, and on sections of their routes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/road/speed_sections.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout::reference_speeds_test {
namespace {

constexpr std::size_t kSteps = 120;
constexpr double kStep_s = 0.2;
constexpr double kNone_mps = std::numeric_limits<double>::infinity();

const scenario::Scenario& shipped() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/speeds.yaml"});
  return kScenario;
}

/// Each car somewhere on its route, with a speed of its own and a slower section.
scenario::Scenario with_drawn_speeds(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto drawn = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  scenario::Scenario scenario = scenario::with_random_starts(shipped(), seed);
  for (scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    const double own_mps = drawn(0.3, 0.8);
    const double from_s_m = drawn(0.0, vehicle.path.length_m());
    vehicle.reference_speed_mps = own_mps;
    const double section_mps = drawn(std::min(own_mps, 0.4), own_mps);  // 0.4: the slowest trims
    vehicle.speed_sections = {{from_s_m, from_s_m + drawn(0.5, 3.0), section_mps}};
  }
  return scenario;
}

/// Of the trims that are not slower the slowest: 0.4, 0.6 or 0.8 m/s, each of which is straight.
double trim_speed_for(double speed_mps) {
  double lowest_mps = kNone_mps;
  for (const automaton::Trim& trim : shipped().subgraph->automaton().trims) {
    if (trim.speed_mps >= speed_mps) lowest_mps = std::min(lowest_mps, trim.speed_mps);
  }
  return lowest_mps;
}

/// What a car drove in a step.
struct Driven {
  double top_mps{};
  double way_m{};
  double section_mps{kNone_mps};  ///< of the section in which the step began
};

Driven driven(const scenario::ScenarioVehicle& vehicle, const coordination::Plan& plan,
              StepIndex step) {
  const Point from_m = plan.pose_at(step).position_m();
  const double s_m = vehicle.path.project(from_m).s_m;
  return {.top_mps = automaton::top_speed_mps(plan.maneuver_during(step)),
          .way_m = (plan.pose_at({step.value + 1}).position_m() - from_m).norm(),
          .section_mps = road::least_speed_mps(vehicle.speed_sections, vehicle.path, s_m,
                                               s_m + 1e-3, kNone_mps)};
}

/// Of each car all steps.
std::vector<std::vector<Driven>> drive(const scenario::Scenario& scenario) {
  Rollout rollout = make_rollout(scenario);
  std::vector<std::vector<Driven>> all(scenario.vehicles.size());
  for (std::size_t k = 0; k < kSteps; ++k) {
    const StepIndex step = rollout.next_step();
    static_cast<void>(rollout.step());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].push_back(
          driven(scenario.vehicles[i], rollout.controllers()[i]->plan_in_force(), step));
    }
  }
  return all;
}

// On a section it may take turns with two trims, but not drive farther in two steps than with the
// one that is not slower than the section's speed.
void expect_on_sections(const std::vector<Driven>& steps, std::size_t& num_on_sections) {
  for (std::size_t k = 1; k < steps.size(); ++k) {
    if (std::max(steps[k - 1].section_mps, steps[k].section_mps) == kNone_mps) continue;
    const double most_mps = trim_speed_for(steps[k].section_mps);
    EXPECT_LE(steps[k - 1].way_m + steps[k].way_m, 2.0 * kStep_s * most_mps + 1e-3) << "step " << k;
    ++num_on_sections;
  }
}

TEST(ReferenceSpeeds, AreKeptWithinWhatTheTrimsAllow) {
  std::size_t num_on_sections = 0;
  std::size_t num_driving = 0;
  for (std::uint64_t seed = 1; seed <= test::num_seeds(20); ++seed) {
    const scenario::Scenario scenario = with_drawn_speeds(seed);
    const std::vector<std::vector<Driven>> all = drive(scenario);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double own_mps = scenario.vehicles[i].reference_speed_mps.value();
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", car " << i << " at " << own_mps);
      for (const Driven& step : all[i]) {
        EXPECT_LE(step.top_mps, trim_speed_for(own_mps) + 1e-9);
        if (step.top_mps > 0.3) ++num_driving;
      }
      expect_on_sections(all[i], num_on_sections);
    }
  }
  EXPECT_GT(num_on_sections, 400U);
  EXPECT_GT(num_driving, 4000U);
}

TEST(ReferenceSpeeds, OfTheOthersArePartOfPlanningForThem) {
  scenario::Scenario scenario = shipped();
  scenario.rounds = controller::Rounds::kTwo;
  for (const scenario::ScenarioVehicle& one : scenario.vehicles) {
    const auto planner = scenario::make_controller(scenario, one.id);
    for (const scenario::ScenarioVehicle& other : scenario.vehicles) {
      const auto replica = planner->options().others(other.id);
      const auto own = scenario::make_controller(scenario, other.id);
      EXPECT_EQ(replica->planning_basis(), own->planning_basis())
          << one.name << " plans for " << other.name;
      EXPECT_EQ(replica->options().reference_speed_mps, other.reference_speed_mps.value_or(0.8));
    }
  }
}

TEST(ReferenceSpeeds, LeadToTheSamePlansInTwoRounds) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(2); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    scenario::Scenario scenario = with_drawn_speeds(seed);
    Rollout sequential = make_rollout(scenario);
    scenario.rounds = controller::Rounds::kTwo;
    Rollout two = make_rollout(scenario);
    two.exchange_in(controller::Rounds::kTwo);
    for (std::size_t k = 0; k < 25; ++k) {
      const auto first = sequential.step();
      const auto second = two.step();
      for (std::size_t i = 0; i < first.size(); ++i) {
        ASSERT_EQ(first[i].planned_pose, second[i].planned_pose) << "step " << k;
        ASSERT_EQ(first[i].cost_m2, second[i].cost_m2) << "step " << k;
      }
    }
  }
}

}  // namespace
}  // namespace hlc::rollout::reference_speeds_test
