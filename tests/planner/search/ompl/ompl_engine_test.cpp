#include "planner/search/ompl/ompl_engine.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::search {

static void PrintTo(Engine engine, std::ostream* out) {
  *out << (engine == Engine::kBranchAndBound ? "BranchAndBound" : "BestFirst");
}

namespace {

constexpr std::size_t kMaxSteps = 8;

class OmplEngineTest : public testing::TestWithParam<Engine> {
 protected:
  [[nodiscard]] std::unique_ptr<SearchEngine> engine(SearchOptions options = {}) const {
    options.engine = GetParam();
    return make_search_engine(subgraph_, reachable_, options);
  }

  [[nodiscard]] std::unique_ptr<SearchEngine> through_ompl(SearchOptions options = {}) const {
    options.factory = make_ompl_engine;
    return engine(options);
  }

  automaton::Subgraph subgraph_{test::make_test_subgraph()};
  automaton::ReachableSets reachable_{subgraph_, kMaxSteps};
};

void expect_same(const SearchResult& one, const SearchResult& other) {
  EXPECT_EQ(one.status, other.status);
  EXPECT_EQ(one.reason, other.reason);
  EXPECT_EQ(one.cost, other.cost);
  EXPECT_EQ(one.lower_bound, other.lower_bound);
  EXPECT_EQ(one.maneuvers, other.maneuvers);
  EXPECT_EQ(one.poses, other.poses);
  EXPECT_EQ(one.generated, other.generated);
  EXPECT_EQ(one.expanded, other.expanded);
}

TEST_P(OmplEngineTest, PlansLikeTheEngineAgainAndAgain) {
  const auto alone = engine();
  const auto through = through_ompl();
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::size_t horizon_steps = 1 + test::pick(random, kMaxSteps);
    const HorizonProblem problem = test::random_problem(subgraph_, horizon_steps, random);
    expect_same(through->search(problem), alone->search(problem));
  }
}

TEST_P(OmplEngineTest, StopsWhenToldToLikeTheEngine) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  for (const bool stops : {true, false}) {
    const auto stop = [stops] { return stops; };
    expect_same(through_ompl()->search(problem, stop), engine()->search(problem, stop));
  }
  expect_same(through_ompl({.max_expansions = 1})->search(problem),
              engine({.max_expansions = 1})->search(problem));
}

INSTANTIATE_TEST_SUITE_P(Engines, OmplEngineTest,
                         testing::Values(Engine::kBranchAndBound, Engine::kBestFirst),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace hlc::search
