#include "planner/search/ompl/ompl_planner.hpp"

#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <numbers>

#include "planner/search/search_engine.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/plan_check.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace ob = ompl::base;

namespace hlc::search {
namespace {

constexpr std::size_t kMaxSteps = 8;

class OmplPlannerTest : public testing::Test {
 protected:
  [[nodiscard]] RecedingHorizonPlanner make_planner(SearchOptions options = {}) const {
    return RecedingHorizonPlanner(si_, subgraph_, reachable_, options);
  }

  [[nodiscard]] std::unique_ptr<SearchEngine> make_engine(SearchOptions options = {}) const {
    return make_search_engine(subgraph_, reachable_, options);
  }

  [[nodiscard]] static HorizonProblem infeasible_problem() {
    HorizonProblem problem = test::straight_problem(kMaxSteps);
    problem.obstacles_m.assign(kMaxSteps, {test::box(-9.0, 9.0, -9.0, 9.0)});
    return problem;
  }

  [[nodiscard]] std::shared_ptr<HorizonProblemDefinition> define(
      const HorizonProblem& problem) const {
    return std::make_shared<HorizonProblemDefinition>(si_, subgraph_, problem);
  }

  automaton::Subgraph subgraph_{test::make_test_subgraph()};
  automaton::ReachableSets reachable_{subgraph_, kMaxSteps};
  ob::SpaceInformationPtr si_{make_space_information(subgraph_, kMaxSteps)};
};

void expect_path_is_plan(const ompl::geometric::PathGeometric& path, const SearchResult& plan,
                         const HorizonProblem& problem) {
  ASSERT_EQ(path.getStateCount(), plan.poses.size() + 1);
  const HorizonState start = read_state(*path.getState(0));
  EXPECT_EQ(start.pose.position_m(), problem.start.position_m());
  EXPECT_EQ(start.trim, problem.start_trim);
  EXPECT_EQ(start.step, 0);
  for (std::size_t j = 0; j < plan.poses.size(); ++j) {
    const HorizonState state = read_state(*path.getState(static_cast<unsigned>(j + 1)));
    EXPECT_EQ(state.pose.position_m(), plan.poses[j].position_m());
    EXPECT_EQ(state.pose.heading_rad, wrap_angle(plan.poses[j].heading_rad));
    EXPECT_EQ(state.trim, plan.maneuvers[j]->to);
    EXPECT_EQ(state.step, j + 1);
  }
}

TEST_F(OmplPlannerTest, GivesThroughPlainOmplTheSamePathAsTheEngine) {
  const auto engine = make_engine();
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(40); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(subgraph_, 6, random);
    const SearchResult plan = engine->search(problem, never_stop);

    const ob::PlannerPtr planner =
        std::make_shared<RecedingHorizonPlanner>(si_, subgraph_, reachable_, SearchOptions{});
    const ob::ProblemDefinitionPtr definition = define(problem);
    planner->setProblemDefinition(definition);
    planner->setup();
    planner->checkValidity();
    const ob::PlannerStatus status = planner->solve(ob::plannerNonTerminatingCondition());

    ASSERT_EQ(definition->hasExactSolution(), plan.status == SearchStatus::kOptimal);
    ASSERT_EQ(static_cast<bool>(status), plan.status == SearchStatus::kOptimal);
    if (!status) {
      continue;
    }
    ++solved;
    auto& path = *definition->getSolutionPath()->as<ompl::geometric::PathGeometric>();
    expect_path_is_plan(path, plan, problem);
    EXPECT_NEAR(path.cost(definition->getOptimizationObjective()).value(), plan.cost, 1e-9);
    EXPECT_TRUE(definition->getGoal()->isSatisfied(path.getStates().back()));
    EXPECT_FALSE(definition->getGoal()->isSatisfied(path.getStates().front()));
    EXPECT_TRUE(definition->hasOptimizedSolution());
  }
  EXPECT_GT(solved, 20);
}

TEST_F(OmplPlannerTest, ADefinitionThatPosesAnotherProblemIsLikeANewOne) {
  const HorizonProblem open = test::straight_problem(kMaxSteps);
  const HorizonProblem closed = infeasible_problem();
  HorizonProblem ahead = test::straight_problem(kMaxSteps);
  ahead.start.x_m += 1.0;
  for (Point& point : ahead.reference_m) point.x() += 2.0;

  RecedingHorizonPlanner planner = make_planner();
  const auto definition = define(open);
  planner.setProblemDefinition(definition);
  for (const HorizonProblem* problem :
       std::initializer_list<const HorizonProblem*>{&open, &closed, &ahead}) {
    definition->pose(*problem);
    planner.clear();
    EXPECT_FALSE(definition->hasSolution());
    EXPECT_FALSE(definition->hasSolutionNonExistenceProof());
    EXPECT_EQ(read_state(*definition->getStartState(0)).pose.x_m, problem->start.x_m);
    (void)planner.solve(ob::plannerNonTerminatingCondition());
    EXPECT_EQ(definition->hasSolution(), problem != &closed);
    EXPECT_EQ(definition->hasSolutionNonExistenceProof(), problem == &closed);
    const SearchResult plan = make_engine()->search(*problem, never_stop);
    if (problem == &closed) continue;
    auto& path = *definition->getSolutionPath()->as<ompl::geometric::PathGeometric>();
    expect_path_is_plan(path, plan, *problem);
    EXPECT_NEAR(path.cost(definition->getOptimizationObjective()).value(), plan.cost, 1e-9);
  }
}

TEST_F(OmplPlannerTest, ProvesThatNoPathExists) {
  const HorizonProblem problem = infeasible_problem();
  const auto definition = define(problem);
  RecedingHorizonPlanner planner = make_planner();
  planner.setProblemDefinition(definition);
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()), ob::PlannerStatus::ABORT);
  EXPECT_FALSE(definition->hasSolution());
  EXPECT_TRUE(definition->hasSolutionNonExistenceProof());
  EXPECT_EQ(planner.result().reason, NoPath::kInfeasible);
}

TEST_F(OmplPlannerTest, HonoursTheTerminationCondition) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  const auto definition = define(problem);
  RecedingHorizonPlanner planner = make_planner();
  planner.setProblemDefinition(definition);
  EXPECT_EQ(planner.solve(ob::plannerAlwaysTerminatingCondition()), ob::PlannerStatus::TIMEOUT);
  EXPECT_EQ(planner.result().reason, NoPath::kBudget);
  EXPECT_EQ(planner.result().expanded, 0);
  EXPECT_FALSE(definition->hasSolution());
  EXPECT_FALSE(definition->hasSolutionNonExistenceProof());
  // The same planner solves the same problem when it may.
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()), ob::PlannerStatus::EXACT_SOLUTION);
}

TEST_F(OmplPlannerTest, ReportsAUsedUpBudgetAsTimeout) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  RecedingHorizonPlanner planner = make_planner({.max_expansions = 1});
  planner.setProblemDefinition(define(problem));
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()), ob::PlannerStatus::TIMEOUT);
}

TEST_F(OmplPlannerTest, RefusesProblemsItDoesNotKnow) {
  RecedingHorizonPlanner planner = make_planner();
  planner.setProblemDefinition(std::make_shared<ob::ProblemDefinition>(si_));
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()),
            ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE);
}

TEST_F(OmplPlannerTest, RefusesAStartThatIsNotTheProblems) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  const auto definition = define(problem);
  RecedingHorizonPlanner planner = make_planner();
  planner.setProblemDefinition(definition);
  write_state({{1.0, 2.1, 0.0}, TrimId{6}, 0}, *definition->getStartState(0));
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()), ob::PlannerStatus::INVALID_START);
  definition->clearStartStates();
  EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()), ob::PlannerStatus::INVALID_START);
}

TEST_F(OmplPlannerTest, StatesKeepPoseTrimAndStep) {
  ob::State* state = si_->allocState();
  write_state({{1.5, -2.5, 7.0}, TrimId{11}, 5}, *state);
  const HorizonState read = read_state(*state);
  EXPECT_TRUE(si_->satisfiesBounds(state));
  EXPECT_EQ(read.pose, (Pose{1.5, -2.5, wrap_angle(7.0)}));
  EXPECT_EQ(read.trim, TrimId{11});
  EXPECT_EQ(read.step, 5);
  si_->freeState(state);
}

TEST_F(OmplPlannerTest, PlansFromAHeadingOfPi) {
  HorizonProblem problem = test::straight_problem(kMaxSteps);
  for (const double heading_rad : {std::numbers::pi, -std::numbers::pi}) {
    problem.start.heading_rad = heading_rad;
    const auto definition = define(problem);
    EXPECT_TRUE(si_->satisfiesBounds(definition->getStartState(0)));
    RecedingHorizonPlanner planner = make_planner();
    planner.setProblemDefinition(definition);
    EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()),
              ob::PlannerStatus::EXACT_SOLUTION);
  }
}

TEST_F(OmplPlannerTest, GoalIsTheLastStepInStandstill) {
  HorizonProblem problem = test::straight_problem(kMaxSteps);
  problem.reference_m.resize(4);
  const StandstillGoal goal(si_, subgraph_, problem);
  ob::State* state = si_->allocState();
  const auto is_satisfied = [&](TrimId trim, std::size_t step) {
    write_state({{}, trim, step}, *state);
    return goal.isSatisfied(state);
  };
  EXPECT_TRUE(is_satisfied(TrimId{0}, 4));
  EXPECT_FALSE(is_satisfied(TrimId{0}, 3));
  EXPECT_FALSE(is_satisfied(TrimId{6}, 4));
  si_->freeState(state);
}

TEST_F(OmplPlannerTest, APlanThatEndsOutsideTheGoalsRadiusIsApproximate) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  const auto solve_within = [&](double radius_m) {
    const auto definition = define(problem);
    definition->setGoal(std::make_shared<StandstillGoal>(si_, subgraph_, problem, radius_m));
    RecedingHorizonPlanner planner = make_planner();
    planner.setProblemDefinition(definition);
    const ob::PlannerStatus status = planner.solve(ob::plannerNonTerminatingCondition());
    EXPECT_EQ(definition->hasApproximateSolution(),
              status == ob::PlannerStatus::APPROXIMATE_SOLUTION);
    const Point end_m = planner.result().poses.back().position_m();
    EXPECT_EQ(status == ob::PlannerStatus::EXACT_SOLUTION,
              (end_m - problem.reference_m.back()).norm() <= radius_m);
    return status;
  };
  EXPECT_EQ(solve_within(1.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(solve_within(0.001), ob::PlannerStatus::APPROXIMATE_SOLUTION);
}

TEST_F(OmplPlannerTest, ParametersTakeEffectAtTheNextSolve) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  RecedingHorizonPlanner planner = make_planner();
  const auto solve = [&] {
    planner.clear();
    planner.setProblemDefinition(define(problem));
    return planner.solve(ob::plannerNonTerminatingCondition());
  };
  EXPECT_EQ(solve(), ob::PlannerStatus::EXACT_SOLUTION);
  ob::ParamSet& parameters = planner.params();
  EXPECT_TRUE(parameters.setParam("max_expansions", "1"));
  EXPECT_EQ(solve(), ob::PlannerStatus::TIMEOUT);
  EXPECT_EQ(planner.result().expanded, 1);
  EXPECT_TRUE(parameters.setParam("max_expansions", "100000"));
  EXPECT_EQ(solve(), ob::PlannerStatus::EXACT_SOLUTION);
  for (const char* engine : {"branch_and_bound", "best_first"}) {
    EXPECT_TRUE(parameters.setParam("engine", engine));
    EXPECT_EQ(parameters["engine"].getValue(), engine);
    EXPECT_EQ(solve(), ob::PlannerStatus::EXACT_SOLUTION);
  }
  EXPECT_EQ(planner.options().engine, Engine::kBestFirst);
}

TEST_F(OmplPlannerTest, ParametersThatAreNotAllowedAreRefused) {
  RecedingHorizonPlanner planner = make_planner();
  ob::ParamSet& parameters = planner.params();
  for (const char* text : {"0", "-3", "12abc", "", "99999999999999999999999"}) {
    EXPECT_FALSE(parameters.setParam("max_expansions", text)) << text;
  }
  EXPECT_FALSE(parameters.setParam("engine", "fast"));
  EXPECT_FALSE(parameters.setParam("cost_to_go", "straight"));
  EXPECT_EQ(planner.options().max_expansions, SearchOptions{}.max_expansions);
  EXPECT_EQ(planner.options().engine, SearchOptions{}.engine);

  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  planner.setProblemDefinition(define(problem));
  EXPECT_TRUE(parameters.setParam("engine", "branch_and_bound"));
  EXPECT_TRUE(parameters.setParam("cost_to_go", "2022"));
  EXPECT_THROW(planner.solve(ob::plannerNonTerminatingCondition()), std::invalid_argument);
}

TEST_F(OmplPlannerTest, PlannerDataHoldsThePathOfTheLastSolve) {
  const HorizonProblem problem = test::straight_problem(kMaxSteps);
  RecedingHorizonPlanner planner = make_planner();
  const auto definition = define(problem);
  planner.setProblemDefinition(definition);
  planner.solve(ob::plannerNonTerminatingCondition());
  ob::PlannerData data(si_);
  planner.getPlannerData(data);
  ASSERT_EQ(data.numVertices(), kMaxSteps + 1);
  ASSERT_EQ(data.numEdges(), kMaxSteps);
  EXPECT_TRUE(data.isStartVertex(0));
  EXPECT_TRUE(data.isGoalVertex(kMaxSteps));
  double sum_m2 = 0.0;
  for (unsigned j = 0; j < kMaxSteps; ++j) {
    EXPECT_EQ(read_state(*data.getVertex(j).getState()).step, j);
    ob::Cost term;
    ASSERT_TRUE(data.getEdgeWeight(j, j + 1, &term));
    sum_m2 += term.value();
  }
  EXPECT_NEAR(sum_m2, planner.result().cost, 1e-12);
  planner.clear();
  ob::PlannerData nothing(si_);
  planner.getPlannerData(nothing);
  EXPECT_EQ(nothing.numVertices(), 0U);
}

TEST_F(OmplPlannerTest, WritesANewPathIntoTheFormerOneOnlyIfNobodyElseHasThat) {
  RecedingHorizonPlanner planner = make_planner();
  HorizonProblem problem = test::straight_problem(kMaxSteps);
  const auto solve = [&] {
    const auto definition = define(problem);
    planner.clear();
    planner.setProblemDefinition(definition);
    EXPECT_EQ(planner.solve(ob::plannerNonTerminatingCondition()),
              ob::PlannerStatus::EXACT_SOLUTION);
    return definition->getSolutionPath();
  };
  const auto geometric = [](const ob::PathPtr& path) -> ompl::geometric::PathGeometric& {
    return *path->as<ompl::geometric::PathGeometric>();
  };
  const auto move_on = [&] {
    planner.setProblemDefinition(nullptr);  // it has the path, too
    problem.start.x_m += 0.01;
    problem.start.heading_rad += 0.1;
  };

  ob::PathPtr held = solve();
  const ompl::geometric::PathGeometric copy(geometric(held));
  move_on();
  ob::PathPtr second = solve();
  ASSERT_EQ(geometric(held).getStateCount(), copy.getStateCount());
  for (unsigned j = 0; j < copy.getStateCount(); ++j) {
    EXPECT_TRUE(si_->equalStates(geometric(held).getState(j), copy.getState(j))) << "state " << j;
  }

  const std::weak_ptr<ob::Path> former = second;
  const ob::State* const former_start = geometric(second).getState(0);
  second.reset();
  move_on();
  const ob::PathPtr third = solve();
  EXPECT_EQ(former.lock(), third);
  EXPECT_EQ(geometric(third).getState(0), former_start);
  expect_path_is_plan(geometric(third), planner.result(), problem);
}

TEST_F(OmplPlannerTest, OmplIsSilent) {
  EXPECT_EQ(ompl::msg::getLogLevel(), ompl::msg::LOG_NONE);
  EXPECT_EQ(ompl::msg::getOutputHandler(), nullptr);
}

}  // namespace
}  // namespace hlc::search
