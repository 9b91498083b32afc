// How many vertices the searches expand: exact numbers, on closed-form (J2) maneuvers. A change of
// an engine that expands others shows here; where it is meant, the table is to be renewed.
#include <gtest/gtest.h>

#include <string>

#include "tests/benchmarks/contestants.hpp"
#include "tests/benchmarks/problem_sets.hpp"

namespace hlc::test::expansion_counts_test {
namespace {

ProblemSet make(const std::string& name, std::size_t max_problems) {
  static ProblemSets sets;
  return sets.make(name, max_problems);
}

struct Total {
  std::size_t generated{};
  std::size_t expanded{};
};

Total total_of(const ProblemSet& set, const std::string& engine) {
  const automaton::ReachableSets reachable(*set.subgraph, set.horizon_steps);
  const auto contestant = make_contestant(engine, *set.subgraph, reachable);
  Total total;
  for (const search::HorizonProblem& problem : set.problems) {
    contestant->solve(problem);
    total.generated += contestant->solved().generated;
    total.expanded += contestant->solved().expanded;
  }
  return total;
}

/// Vertices expanded on the first problems of a set, all together.
struct Counts {
  const char* set;
  std::size_t problems;
  std::size_t straight_line;  ///< plain search, and best-first with the straight-line bound
  std::size_t best_first;
  std::size_t branch_and_bound;
};

const Counts kCounts[] = {
    {"three_cars", 150, 39'220, 3'207, 3'740},
    {"three_cars_corridor", 150, 16'666, 3'862, 4'989},
    {"random_starts", 100, 31'135, 1'237, 1'593},
    {"cars_19", 50, 26'618, 3'104, 3'786},
    {"horizon_12", 20, 74'591, 1'072, 1'489},
    {"trims_95", 10, 104'234, 196, 448},
    {"infeasible_random", 10, 171, 171, 171},
};

TEST(ExpansionCounts, AreThoseOfTheTable) {
  for (const Counts& counts : kCounts) {
    SCOPED_TRACE(counts.set);
    const ProblemSet set = make(counts.set, counts.problems);
    EXPECT_EQ(total_of(set, kPlain).expanded, counts.straight_line);
    EXPECT_EQ(total_of(set, "best_first_straight_line").expanded, counts.straight_line);
    EXPECT_EQ(total_of(set, "best_first").expanded, counts.best_first);
    EXPECT_EQ(total_of(set, "branch_and_bound").expanded, counts.branch_and_bound);
  }
}

/// What the bound from reachable sets is worth.
struct Gain {
  const char* set;
  std::size_t problems;
  std::size_t times_fewer;  ///< at least, than with the straight-line bound
};

TEST(ExpansionCounts, TheReachableBoundSavesMostExpansionsOfBestFirst) {
  for (const Gain& gain : {Gain{"three_cars", 150, 8}, Gain{"three_cars_corridor", 150, 3},
                           Gain{"maneuvers_j1", 200, 8}, Gain{"trims_95", 10, 100}}) {
    SCOPED_TRACE(gain.set);
    const ProblemSet set = make(gain.set, gain.problems);
    EXPECT_LE(gain.times_fewer * total_of(set, "best_first").expanded,
              total_of(set, kPlain).expanded);
  }
}

// With every end blocked each vertex from which standstill is within the steps left is expanded
// once, whatever the bound.
TEST(ExpansionCounts, AWholeTreeOfThePapersTwelveTrimsHasAKnownSize) {
  struct Tree {
    std::size_t start_trim;  ///< from 1, as in the paper
    std::size_t generated;
    std::size_t expanded;
  };
  for (const Tree& tree : {Tree{1, 560'527, 309'029}, Tree{7, 236'257, 130'251}}) {
    ProblemSet set = make("infeasible", 1);
    set.problems.front().start_trim = TrimId{tree.start_trim - 1};
    for (const char* engine : {kPlain, "best_first", "branch_and_bound"}) {
      SCOPED_TRACE(std::string(engine) + " from trim " + std::to_string(tree.start_trim));
      const Total total = total_of(set, engine);
      EXPECT_EQ(total.generated, tree.generated);
      EXPECT_EQ(total.expanded, tree.expanded);
    }
  }
}

}  // namespace
}  // namespace hlc::test::expansion_counts_test
