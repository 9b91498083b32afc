// Requests for other subgraphs at random times while three cars drive.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <stdexcept>

#include "planner/automaton/requested_subgraph.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plans_in_force.hpp"

namespace hlc::scenario::random_requests_test {
namespace {

using Random = std::mt19937_64;

std::size_t draw(Random& random, std::size_t last) {
  return std::uniform_int_distribution<std::size_t>{0, last}(random);
}

SubgraphRequest random_request(Random& random) {
  SubgraphRequest request;
  const char* const labels[] = {"J1", "J2", "J3"};
  if (draw(random, 2) > 0) request.labels = {labels[draw(random, 2)]};
  if (draw(random, 2) == 0) {
    request.max_speed_mps = 0.4 + 0.1 * static_cast<double>(draw(random, 16));
  }
  for (std::size_t k = draw(random, 2); k > 0; --k) {
    request.disable_trims.push_back({1 + draw(random, 10)});
  }
  for (std::size_t k = draw(random, 2); k > 0; --k) {
    request.disable_edges.push_back({{draw(random, 11)}, {draw(random, 11)}});
  }
  return request;
}

/// One that is not refused. Half of them are of another automaton object, as for new weights.
std::shared_ptr<const automaton::Subgraph> random_subgraph(const automaton::Subgraph& base,
                                                           std::size_t horizon_steps,
                                                           Random& random) {
  std::shared_ptr<const automaton::UniversalAutomaton> automaton = base.shared_automaton();
  if (draw(random, 1) == 0)
    automaton = std::make_shared<const automaton::UniversalAutomaton>(*automaton);
  while (true) {
    try {
      return automaton::requested_subgraph(base, random_request(random), horizon_steps, automaton);
    } catch (const std::invalid_argument&) {
      continue;
    }
  }
}

/// The same cars, of which none was asked.
struct Counterpart {
  rollout::Rollout without;
  std::size_t asked;
  std::size_t steps_left;
};

struct Drive {
  std::size_t requests;
  std::size_t planned;
  std::size_t infeasible_by_switch;  ///< in the very step, and not without the request
  std::size_t infeasible_later;      ///< in the horizon after it
};

void drive(const Scenario& three_cars, std::uint64_t seed, Drive& sums) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const automaton::Subgraph& base = *three_cars.subgraph;
  Random random(seed);
  rollout::Rollout rollout = rollout::make_rollout(with_random_starts(three_cars, seed));
  std::vector<Counterpart> counterparts;
  for (std::size_t k = 0; k < 150; ++k) {
    if (k > 2 && draw(random, 2) == 0) {
      const std::size_t asked = draw(random, 2);
      counterparts.push_back({rollout.clone(), asked, three_cars.horizon_steps + 1});
      rollout.controllers()[asked]->switch_to(
          random_subgraph(base, three_cars.horizon_steps, random));
      ++sums.requests;
    }
    const std::vector<coordination::Report> reports = rollout.step();
    ASSERT_TRUE(test::plans_in_force_are_free(rollout)) << "step " << k;
    for (std::size_t i = 0; i < reports.size(); ++i) {
      const coordination::Report& report = reports[i];
      sums.planned += report.status == coordination::StepStatus::kPlanned ? 1U : 0U;
      EXPECT_NE(report.quality, coordination::PlanQuality::kBudget) << "step " << k;
      EXPECT_LE(report.expanded, three_cars.search.max_expansions);
      const controller::Controller& controller = *rollout.controllers()[i];
      const coordination::Plan& plan = controller.plan_in_force();
      EXPECT_TRUE(base.automaton().trims[plan.trim_at(plan.end()).index].is_equilibrium());
    }
    for (Counterpart& counterpart : counterparts) {
      const std::vector<coordination::Report> otherwise = counterpart.without.step();
      --counterpart.steps_left;
      const bool is_infeasible =
          reports[counterpart.asked].reason == coordination::FallbackReason::kInfeasible &&
          otherwise[counterpart.asked].reason != coordination::FallbackReason::kInfeasible;
      const bool is_switch = counterpart.steps_left == three_cars.horizon_steps;
      (is_switch ? sums.infeasible_by_switch : sums.infeasible_later) += is_infeasible ? 1U : 0U;
    }
    std::erase_if(counterparts,
                  [](const Counterpart& counterpart) { return counterpart.steps_left == 0; });
  }
}

Scenario three_cars() {
  return read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/on_request.yaml"});
}

TEST(RandomRequests, NeverLeaveACarWithoutAPlanNorLeadToACollision) {
  const Scenario scenario = three_cars();
  Drive sums{};
  const std::uint64_t seeds = test::num_costly_seeds(22);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) drive(scenario, seed, sums);
  EXPECT_EQ(sums.infeasible_by_switch, 0U) << "of " << sums.requests << " requests";
  // A car that drives otherwise meets the others elsewhere; and what was on before is planned on
  // for a horizon at most.
  EXPECT_LE(sums.infeasible_later, sums.requests / 100) << "of " << sums.requests << " requests";
  EXPECT_GT(sums.requests, 45 * seeds);
  EXPECT_GT(sums.planned, 300 * seeds) << "the cars are to drive";
}

// A path was found on the new subgraph, whose drift led into something, and none without drift.
TEST(RandomRequests, TheFormerSubgraphStaysUntilAPlanOnTheNewOneHolds) {
  Drive sums{};
  drive(three_cars(), 192, sums);
  EXPECT_EQ(sums.infeasible_by_switch, 0U) << "of " << sums.requests << " requests";
  EXPECT_GT(sums.requests, 0U);
}

}  // namespace
}  // namespace hlc::scenario::random_requests_test
