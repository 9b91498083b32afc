#include "vehicle_sim/apps/step_answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "tests/support/folders.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"
#include "vehicle_sim/closed_loop/fork.hpp"

namespace hlc::apps {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

scenario::ScenarioChoices lab_cars() {
  return {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml",
          .cars = 10,
          .seed = 3};
}

scenario::ScenarioChoices reconfiguration(const std::string& policy) {
  return {.file = test::source_folder() + "/launch_scripts/scenarios/reconfiguration.yaml",
          .policy = policy};
}

struct Seen {
  const controller::Controller& controller;
  const policy::SubgraphSelector& chosen;
  const coordination::Report& report;
};

/// @param look  at every step of every vehicle that planned
void drive(const scenario::Scenario& scenario, closed_loop::ExperimentOptions options,
           const std::function<void(const Seen&)>& look) {
  options.after_step = [&](const controller::Controller& controller,
                           const policy::SubgraphSelector& chosen,
                           const coordination::Report& report) {
    if (report.status == coordination::StepStatus::kPlanned) look({controller, chosen, report});
  };
  static_cast<void>(closed_loop::drive_experiment(scenario, options));
}

const ExplainedStep::Limit* named(const StepAnswers& answers, const std::string& begin) {
  const auto found = std::ranges::find_if(answers.limits, [&](const ExplainedStep::Limit& limit) {
    return limit.name.starts_with(begin);
  });
  return found == answers.limits.end() ? nullptr : &*found;
}

/// The limits of several steps.
struct CheckedLimits {
  void check(const StepAnswers& answers) {
    for (const ExplainedStep::Limit& limit : answers.limits) {
      if (!limit.ahead_m && limit.name.starts_with("the end of its right of way")) {
        ++num_askew;
        continue;
      }
      ASSERT_TRUE(limit.ahead_m && limit.extra_m2) << limit.name;
      EXPECT_LE(*limit.extra_m2, 1e-9) << limit.name;
      if (*limit.extra_m2 < -1e-6) that_cost.insert(limit.name);
    }
  }

  std::set<std::string> that_cost;
  std::size_t num_askew{};  ///< on the road of others it finds a plan that ends askew in its lane
};

TEST(StepAnswers, WithoutALimitNoPlanCostsMoreAndOneThatStandsAtTheEndOfItsRoadGoesOn) {
  const scenario::Scenario scenario = scenario::read_scenario(lab_cars());
  CheckedLimits checked;
  std::size_t num_held = 0;
  drive(scenario, {.steps = 20}, [&](const Seen& seen) {
    const std::uint64_t step = seen.controller.last_step().value;
    if (step % 5 != 0) return;
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    checked.check(answers);
    if (answers.alone) {
      EXPECT_LE(*answers.alone->extra_m2, 1e-9);
    }
    const ExplainedStep::Limit* const end = named(answers, "the end of its right of way");
    if (end == nullptr || end->note.empty()) return;
    ++num_held;
    EXPECT_THAT(
        end->note,
        testing::MatchesRegex("(the road ahead|conflict zone [0-9]+, next,) is held by vehicle.*"));
    if (!end->ahead_m) return;
    EXPECT_GE(*end->ahead_m, ahead_m(seen.controller)) << "vehicle " << seen.report.vehicle.value;
  });
  EXPECT_THAT(checked.that_cost,
              testing::IsSupersetOf({"the lane boundary", "the end of its right of way"}));
  EXPECT_GT(num_held, 0U);
  EXPECT_LE(checked.num_askew, 2U);
}

TEST(StepAnswers, AnObstacleOfAForkCostsTheCarInFrontOfIt) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
  const scenario::ScenarioVehicle& car = scenario.vehicles.front();
  const double s_m = car.start_s_m + 2.0;
  const Point at_m = car.path.at(s_m);
  const closed_loop::Fork::Obstacle wall{
      .pose = {at_m.x(), at_m.y(), car.path.heading_rad_at(s_m)}, .length_m = 0.05, .width_m = 0.6};
  double most_saved_m2 = 0.0;
  closed_loop::ExperimentOptions options{.steps = 30};
  options.forks = {{.from = 0, .changes = {wall}}};
  drive(scenario, options, [&](const Seen& seen) {
    if (seen.report.vehicle != car.id) return;
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    const ExplainedStep::Limit* const obstacles = named(answers, "the obstacles");
    if (obstacles == nullptr || !obstacles->extra_m2) return;
    most_saved_m2 = std::max(most_saved_m2, -*obstacles->extra_m2);
  });
  EXPECT_GT(most_saved_m2, 0.1);
}

TEST(StepAnswers, TheAreasOfACarThatPlansBeforeCostSomethingSomewhere) {
  const scenario::Scenario scenario = scenario::read_scenario(reconfiguration("none"));
  bool is_seen = false;
  drive(scenario, {.steps = 40}, [&](const Seen& seen) {
    if (is_seen || seen.report.level == 0) return;
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    is_seen = std::ranges::any_of(answers.limits, [](const ExplainedStep::Limit& limit) {
      return limit.vehicle && *limit.extra_m2 < -1e-6;
    });
    EXPECT_TRUE(!is_seen || *answers.alone->extra_m2 < -1e-6);
  });
  EXPECT_TRUE(is_seen);
}

TEST(StepAnswers, AZoneAndTheRuleOfAPolicyAreNamedAndTheZoneCostsWay) {
  const scenario::Scenario scenario = scenario::read_scenario(reconfiguration("mixed"));
  bool is_zone_seen = false;
  std::set<std::string> requests;
  drive(scenario, {.steps = 12}, [&](const Seen& seen) {
    if (seen.report.quality == coordination::PlanQuality::kBudget) return;  // has no answers
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    const std::string request = request_name(seen.chosen, scenario.policy);
    requests.insert(request);
    EXPECT_NE(named(answers, request), nullptr) << request;
    if (const ExplainedStep::Limit* const zone = named(answers, "zone ")) {
      is_zone_seen = true;
      EXPECT_EQ(zone->name, "zone 1 of policy mixed (at most 0.6 m/s)");
      EXPECT_EQ(zone->name, zone_name(seen.chosen, scenario.policy));
      EXPECT_LE(*zone->extra_m2, 1e-9);
    }
  });
  EXPECT_TRUE(is_zone_seen);
  EXPECT_THAT(requests, testing::Contains("rule 2 of policy mixed (J2, label comfort)"));
}

TEST(StepAnswers, AZoneThatLimitsTheReferenceIsNamedAndCostsWay) {
  const scenario::Scenario scenario = scenario::read_scenario(reconfiguration("zone_reference"));
  double farther_m = 0.0;
  drive(scenario, {.steps = 12}, [&](const Seen& seen) {
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    const ExplainedStep::Limit* const zone = named(answers, "zone 1 of policy zone_reference");
    ASSERT_TRUE(zone == nullptr || seen.chosen.decision().zone.has_value());
    if (zone == nullptr) return;
    EXPECT_LE(*zone->extra_m2, 1e-9);
    farther_m = std::max(farther_m, *zone->ahead_m - ahead_m(seen.controller));
  });
  EXPECT_GT(farther_m, 0.01) << "farther without the limit";
}

TEST(StepAnswers, WhatAForkRequestsIsALimitFromThereOn) {
  const scenario::Scenario scenario = scenario::read_scenario(reconfiguration("none"));
  const closed_loop::Fork fork{
      .from = 4, .changes = {closed_loop::Fork::MaxSpeed{.vehicle = {2}, .max_speed_mps = 0.4}}};
  std::uint64_t first = 0;
  drive(scenario, {.steps = 8, .forks = {fork}}, [&](const Seen& seen) {
    if (first == 0) first = seen.controller.last_step().value;
    const bool is_asked =
        seen.report.vehicle == VehicleId{2} && seen.controller.last_step().value >= first + 4;
    const StepAnswers answers =
        answers_of(seen.controller, seen.chosen, seen.report, scenario.policy);
    const ExplainedStep::Limit* const request = named(answers, "the fork's request");
    EXPECT_EQ(request != nullptr, is_asked) << seen.report.vehicle.value;
    if (request != nullptr) {
      EXPECT_THAT(request->name, HasSubstr("at most 0.4 m/s"));
      EXPECT_LE(*request->extra_m2, 1e-9);
    }
  });
}

TEST(StepAnswers, AnswersChangeNothing) {
  const scenario::Scenario scenario = scenario::read_scenario(lab_cars());
  std::vector<Pose> poses[2];
  for (int i = 0; i < 2; ++i) {
    drive(scenario, {.steps = 8}, [&](const Seen& seen) {
      poses[i].push_back(seen.report.planned_pose);
      if (i == 1) {
        static_cast<void>(answers_of(seen.controller, seen.chosen, seen.report, scenario.policy));
      }
    });
  }
  EXPECT_THAT(poses[0], Not(IsEmpty()));
  EXPECT_EQ(poses[0], poses[1]);
}

}  // namespace
}  // namespace hlc::apps
