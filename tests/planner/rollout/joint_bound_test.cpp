// Report::bound_m2 and the joint optimum of a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "planner/coordination/joint_gap.hpp"
#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::rollout::joint_bound_test {
namespace {

scenario::Scenario read(const std::string& name, const std::string& profile) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + name + ".yaml",
       .profile = profile});
}

/// Steps a scenario, and finds the joint optimum of the vehicles of a gap.
class Steps {
 public:
  explicit Steps(const scenario::Scenario& scenario)
      : rollout_(make_rollout(scenario)),
        on_(scenario::prepare_subgraph_of(scenario)),
        engine_(search::make_search_engine(*on_.subgraph, *on_.reachable,
                                           {.max_expansions = 1'000'000}, on_.tables)) {}

  std::vector<coordination::JointGap> next() {
    reports_ = rollout_.step();
    std::vector<const coordination::Report*> pointers;
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      rollout_.controllers()[i]->note_bound(reports_[i]);
      pointers.push_back(&reports_[i]);
    }
    return coordination::joint_gaps(pointers);
  }

  /// @param keeps_clear  of the plans that the others drive
  [[nodiscard]] joint_search::JointSearchResult optimum_of(const coordination::JointGap& gap,
                                                           bool keeps_clear) const {
    joint_search::JointProblem problem;
    for (const auto& controller : rollout_.controllers()) {
      if (std::ranges::count(gap.vehicles, controller->options().vehicle) == 0) continue;
      search::HorizonProblem one = controller->problems().back().problem;
      const StepIndex now = controller->last_step();
      one.incumbent.clear();
      one.avoids_steering_limit = false;
      one.obstacles_m.assign(one.horizon_steps(), {});
      for (const VehicleId other : controller->coupled()) {
        if (!keeps_clear) break;
        for (std::size_t j = 0; j < one.horizon_steps(); ++j) {
          one.obstacles_m[j].push_back(
              controller->traffic_of(other).running.during({now.value + 1 + j}));
        }
      }
      problem.push_back({.problem = std::move(one), .engine = engine_.get()});
    }
    return joint_search::search_jointly(problem, {.max_expansions = 300'000});
  }

 private:
  Rollout rollout_;
  controller::PreparedSubgraph on_;
  std::unique_ptr<search::SearchEngine> engine_;
  std::vector<coordination::Report> reports_;
};

/// Compares gaps with joint optima.
struct Comparison {
  std::size_t compared{};
  std::size_t wrong_with_one_percent_more{};  ///< the bound
  std::size_t open{};

  void add(const coordination::JointGap& gap, const joint_search::JointSearchResult& optimum) {
    if (optimum.status != search::SearchStatus::kOptimal) return;
    ++compared;
    EXPECT_LE(gap.bound_m2, optimum.cost * (1.0 + 1e-8) + 1e-9);
    EXPECT_GE(gap.cost_m2, optimum.cost * (1.0 - 1e-8) - 1e-9);
    if (1.01 * gap.bound_m2 > optimum.cost * (1.0 + 1e-8)) ++wrong_with_one_percent_more;
    if (!gap.is_closed()) ++open;
  }
};

/// Of ten drives from random starts.
Comparison compare_drives(const std::string& profile, bool keeps_clear) {
  const scenario::Scenario scenario = read("paper_three_cars", profile);
  Comparison comparison;
  for (std::uint64_t seed = 0; seed < test::num_seeds(10); ++seed) {
    Steps steps(scenario::with_random_starts(scenario, seed));
    for (int k = 0; k < 60; ++k) {
      SCOPED_TRACE(profile + ", seed " + std::to_string(seed) + ", step " + std::to_string(k));
      for (const coordination::JointGap& gap : steps.next()) {
        if (gap.is_known) comparison.add(gap, steps.optimum_of(gap, keeps_clear));
      }
    }
  }
  return comparison;
}

TEST(JointBound, TheOptimumLiesBetweenBoundAndCost) {
  const Comparison comparison = compare_drives("default", true);
  EXPECT_GT(comparison.compared, 20U);
  EXPECT_GT(comparison.wrong_with_one_percent_more, comparison.compared / 2);
  EXPECT_GT(comparison.open, 0U) << "nobody was in anybody's way";
}

/// Under the rule `agreed` plans keep clear of new ones only.
TEST(JointBound, TheOptimumLiesBetweenBoundAndCostAlsoUnderTheRulesOf2022) {
  EXPECT_GT(compare_drives("2022", false).compared, 20U);
}

/// Also on circles without lanes.
TEST(JointBound, CostsNoMoreThanThePlan) {
  for (const char* name : {"paper_three_cars", "circle", "lab_ring"}) {
    for (const char* profile : {"default", "2022"}) {
      SCOPED_TRACE(std::string(name) + ", " + profile);
      Steps steps(read(name, profile));
      std::size_t num_known = 0;
      for (int k = 0; k < 40; ++k) {
        for (const coordination::JointGap& gap : steps.next()) {
          num_known += gap.is_known ? 1U : 0U;
          EXPECT_LE(gap.bound_m2, gap.cost_m2 + 1e-9);
          EXPECT_GE(gap.bound_m2, 0.0);
        }
      }
      EXPECT_GT(num_known, 10U);
    }
  }
}

}  // namespace
}  // namespace hlc::rollout::joint_bound_test
