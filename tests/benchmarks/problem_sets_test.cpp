#include "tests/benchmarks/problem_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/benchmarks/plain_search.hpp"

namespace hlc::test::problem_sets_test {
namespace {

ProblemSet make(const std::string& name, std::size_t max_problems = 0) {
  static ProblemSets sets;
  return sets.make(name, max_problems);
}

/// Problems whose best plan the other cars change.
std::size_t num_changed(const ProblemSet& set) {
  const PlainSearch search(*set.subgraph);
  std::size_t changed = 0;
  for (const search::HorizonProblem& problem : set.problems) {
    const PlainResult plan = search.search(problem);
    EXPECT_TRUE(plan.feasible);
    search::HorizonProblem alone = problem;
    alone.obstacles_m.clear();
    changed += search.search(alone).cost < plan.cost - 1e-9 ? 1U : 0U;
  }
  return changed;
}

bool has_boundary(const search::HorizonProblem& problem) { return !problem.boundary_m.empty(); }

TEST(ThreeCars, RedAlwaysHasAPlanAndTheOthersChangeItInThirtyStepsAndMore) {
  for (const char* name : {"three_cars", "three_cars_corridor"}) {
    SCOPED_TRACE(name);
    const ProblemSet set = make(name);
    EXPECT_EQ(set.problems.size(), 150U);
    EXPECT_GE(num_changed(set), 30U);
  }
}

TEST(ThreeCars, OnlyTheCorridorHasABoundary) {
  EXPECT_TRUE(std::ranges::none_of(make("three_cars", 20).problems, has_boundary));
  EXPECT_TRUE(std::ranges::all_of(make("three_cars_corridor", 20).problems, has_boundary));
}

TEST(ProblemSets, OnlyOneSetHasIncumbents) {
  for (const char* name : {"three_cars", "three_cars_corridor", "random_starts"}) {
    const ProblemSet set = make(name, 5);
    for (const search::HorizonProblem& problem : set.problems) {
      EXPECT_TRUE(problem.incumbent.empty());
    }
  }
}

TEST(ProblemSets, InRandomTrafficOthersLeaveAPlanAndChangeSome) {
  EXPECT_GE(num_changed(make("random_starts", 100)), 3U);
  EXPECT_GE(num_changed(make("cars_19", 50)), 10U);
  EXPECT_GE(num_changed(make("horizon_12", 30)), 1U);
}

TEST(ProblemSets, SetsHaveTheCarsTheStepsAndTheTrimsOfTheirNames) {
  for (const auto& [name, cars] : {std::pair{"cars_5", 5U}, {"cars_10", 10U}, {"cars_19", 19U}}) {
    const ProblemSet set = make(name, 1);
    for (const auto& areas_m : set.problems.front().obstacles_m) {
      EXPECT_EQ(areas_m.size(), cars) << name;
    }
  }
  for (const auto& [name, n] :
       {std::pair{"horizon_8", 8U}, {"horizon_12", 12U}, {"horizon_16", 16U}}) {
    EXPECT_EQ(make(name, 1).problems.front().horizon_steps(), n) << name;
    EXPECT_EQ(make(name, 1).horizon_steps, n) << name;
  }
  for (const auto& [name, trims] :
       {std::pair{"trims_12", 12U}, {"trims_34", 34U}, {"trims_95", 95U}}) {
    EXPECT_EQ(make(name, 1).subgraph->trims().size(), trims) << name;
  }
}

TEST(ProblemSets, NothingOfTheInfeasibleSetsHasAPlan) {
  for (const auto& [name, problems] : {std::pair{"infeasible", 1U}, {"infeasible_random", 10U}}) {
    const ProblemSet set = make(name, problems);
    const PlainSearch search(*set.subgraph);
    for (const search::HorizonProblem& problem : set.problems) {
      EXPECT_FALSE(search.search(problem).feasible) << name;
    }
  }
}

TEST(ProblemSets, TheSameNameGivesTheSameProblems) {
  for (const char* name : {"three_cars_corridor", "random_starts"}) {
    ProblemSets again;
    const ProblemSet first = make(name, 10);
    const ProblemSet second = again.make(name, 10);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(first.problems[i].start, second.problems[i].start);
      EXPECT_EQ(first.problems[i].start_trim, second.problems[i].start_trim);
      EXPECT_EQ(first.problems[i].reference_m, second.problems[i].reference_m);
      EXPECT_EQ(first.problems[i].obstacles_m, second.problems[i].obstacles_m);
    }
  }
}

TEST(ProblemSets, AnUnknownNameIsRefusedWithTheAllowedOnes) {
  try {
    static_cast<void>(make("four_cars"));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("four_cars, must be one of three_cars,"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace hlc::test::problem_sets_test
