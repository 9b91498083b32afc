// Three cars that change their subgraphs themselves, by random zones and rules, from random starts.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "planner/policy/policy_check.hpp"
#include "planner/policy/speed_zones.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::scenario::random_policies_test {
namespace {

using Random = std::mt19937_64;

constexpr double kRounding_mps = 1e-6;

double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

SubgraphRequest random_request(Random& random) {
  static const std::vector<std::vector<std::string>> kLabels{
      {}, {"J1"}, {"J2"}, {"comfort"}, {"J1", "J2"}};
  SubgraphRequest request{.labels = kLabels[random() % kLabels.size()]};
  if (request.labels != kLabels[1] && random() % 4 == 0) request.max_speed_mps = 0.6;
  return request;
}

/// Several zones, which may overlap, and all kinds of rules.
policy::ReconfigurationSettings random_settings(Random& random) {
  policy::ReconfigurationSettings settings{.min_stay_s = uniform(random, 0.0, 2.0)};
  for (std::uint64_t i = random() % 4; i > 0; --i) {
    const double x_m = uniform(random, 0.0, 4.0);
    const double y_m = uniform(random, 0.0, 4.0);
    settings.zones.push_back({.min_x_m = x_m,
                              .max_x_m = x_m + uniform(random, 0.1, 1.5),
                              .min_y_m = y_m,
                              .max_y_m = y_m + uniform(random, 0.1, 1.5),
                              .max_speed_mps = random() % 2 == 0 ? 0.4 : 0.6});
  }
  policy::TimePolicySettings time;
  for (double from_s = uniform(random, 5.0, 10.0); from_s < 30.0;
       from_s += uniform(random, 0.2, 5.0)) {
    time.changes.push_back({from_s, random_request(random)});
  }
  const policy::SituationPolicySettings situation{.open_road = random_request(random),
                                                  .conflict = random_request(random),
                                                  .after_conflict_s = uniform(random, 0.0, 1.0)};
  const policy::LookAheadSettings look_ahead{
      .candidates = {random_request(random), random_request(random)},
      .steps = 3,
      .criterion_weights = {{"J2", uniform(random, 0.0, 0.001)}},
      .max_expansions = 300};
  if (random() % 2 == 0) settings.policies.emplace_back(time);
  if (random() % 4 == 0) {
    settings.policies.emplace_back(look_ahead);
  } else {
    settings.policies.emplace_back(situation);
  }
  return settings;
}

TEST(RandomPolicies, NeverLeadToACollisionNorMakeACarThatPlansTooFastInAZone) {
  Scenario three_cars = read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/reconfiguration.yaml",
       .policy = policy::kNoPolicy});
  three_cars.search.max_expansions = 2000;
  std::size_t planned = 0;
  std::size_t switches = 0;
  std::size_t in_zone = 0;
  std::size_t too_fast = 0;
  const std::uint64_t seeds = test::num_costly_seeds(20);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const policy::ReconfigurationSettings settings = random_settings(random);
    ASSERT_NO_THROW(policy::check_reconfiguration(*three_cars.subgraph, settings,
                                                  three_cars.horizon_steps, {}));
    rollout::Rollout rollout = rollout::make_rollout(with_random_starts(three_cars, seed));
    rollout.choose_by(settings);
    std::vector<const automaton::Subgraph*> before(3);
    // Steps since it drove what was agreed before, or planned on what was on before.
    std::vector<std::size_t> found_a_way(3);
    for (std::size_t k = 0; k < 150; ++k) {
      const std::vector<coordination::Report> reports = rollout.step();
      ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << k;
      for (std::size_t i = 0; i < reports.size(); ++i) {
        const controller::Controller& controller = *rollout.controllers()[i];
        planned += reports[i].status == coordination::StepStatus::kPlanned ? 1U : 0U;
        switches += &controller.subgraph() != before[i] ? 1U : 0U;
        before[i] = &controller.subgraph();
        const road::ReferencePath& path = controller.route().path;
        const double s_m = path.project(reports[i].planned_pose.position_m()).s_m;
        const std::optional<double> limit = policy::limit_on(settings.zones, path, s_m, 0.0);
        if (!limit) continue;
        ++in_zone;
        const automaton::Maneuver& maneuver =
            controller.plan_in_force().maneuver_during(reports[i].step);
        const bool is_too_fast = automaton::top_speed_mps(maneuver) > *limit + kRounding_mps;
        too_fast += is_too_fast ? 1U : 0U;
        if (is_too_fast) {
          EXPECT_LT(found_a_way[i], three_cars.horizon_steps) << "step " << k;
        }
      }
      for (std::size_t i = 0; i < reports.size(); ++i) {
        const automaton::Subgraph& subgraph = rollout.controllers()[i]->subgraph();
        const bool is_on_it = reports[i].status == coordination::StepStatus::kPlanned &&
                              reports[i].subgraph == subgraph.spec().name;
        found_a_way[i] = is_on_it ? found_a_way[i] + 1 : 0;
      }
    }
  }
  EXPECT_GT(planned, 250 * seeds) << "the cars are to drive";
  EXPECT_GT(switches, 15 * seeds);
  EXPECT_GT(in_zone, 10 * seeds);
  EXPECT_LT(static_cast<double>(too_fast), 0.01 * static_cast<double>(in_zone));
}

}  // namespace
}  // namespace hlc::scenario::random_policies_test
