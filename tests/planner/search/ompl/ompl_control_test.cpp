#include "planner/search/ompl/ompl_control.hpp"

#include <gtest/gtest.h>
#include <ompl/control/PlannerData.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/spaces/DiscreteControlSpace.h>
#include <ompl/util/RandomNumbers.h>

#include "planner/search/collision.hpp"
#include "planner/search/ompl/ompl_planner.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace hlc::search {
namespace {

constexpr std::size_t kSteps = 5;

class OmplControlTest : public testing::Test {
 protected:
  automaton::Subgraph subgraph_{test::make_test_subgraph()};
  automaton::ReachableSets reachable_{subgraph_, kSteps};
};

/// What the path of controls means for the automaton: that each of its steps is an edge that a
/// plan may take and that is free.
void expect_plan(const oc::PathControl& path, const HorizonProblem& problem,
                 const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable) {
  CollisionCheck collision(subgraph, reachable);
  collision.prepare(problem);
  ASSERT_EQ(path.getStateCount(), problem.horizon_steps() + 1);
  for (unsigned j = 0; j + 1 < path.getStateCount(); ++j) {
    const HorizonState from = read_state(*path.getState(j));
    const HorizonState to = read_state(*path.getState(j + 1));
    EXPECT_EQ(from.step, j);
    EXPECT_EQ(to.step, j + 1);
    bool is_edge = false;
    for (const automaton::Edge& edge :
         subgraph.successors(from.trim, problem.horizon_steps() - from.step)) {
      const Pose end = compose(from.pose, edge.maneuver->displacement);
      is_edge = is_edge ||
                (edge.to == to.trim && (end.position_m() - to.pose.position_m()).norm() < 1e-9 &&
                 collision.is_free(*edge.maneuver, j + 1, to_frame(from.pose)));
    }
    EXPECT_TRUE(is_edge) << j;
  }
  const HorizonState last =
      read_state(*path.getState(static_cast<unsigned>(problem.horizon_steps())));
  EXPECT_TRUE(subgraph.automaton().trims[last.trim.index].is_equilibrium());
}

TEST_F(OmplControlTest, ThePlanIsAPathOfControlsThatOmplItselfFindsGood) {
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(40); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    HorizonProblem problem = test::random_problem(subgraph_, kSteps, random);
    problem.avoids_steering_limit = test::pick(random, 2) == 0;
    const auto si = make_control_space_information(subgraph_, reachable_, problem);
    RecedingHorizonPlanner planner(si, subgraph_, reachable_, {});
    const auto definition = std::make_shared<HorizonProblemDefinition>(si, subgraph_, problem);
    planner.setProblemDefinition(definition);
    if (!planner.solve(ob::plannerNonTerminatingCondition())) continue;
    ++solved;
    const auto& path = dynamic_cast<const oc::PathControl&>(*definition->getSolutionPath());
    EXPECT_NEAR(path_cost(path, *definition->getOptimizationObjective()).value(),
                planner.result().cost, 1e-9);
    EXPECT_TRUE(path.check()) << "states, controls and obstacles agree with the propagator";
    expect_plan(path, problem, subgraph_, reachable_);
    oc::PlannerData data(si);
    planner.getPlannerData(data);
    EXPECT_EQ(data.numEdges(), kSteps);
    const auto& edge = dynamic_cast<const oc::PlannerDataEdgeControl&>(data.getEdge(0U, 1U));
    EXPECT_EQ(edge.getDuration(), subgraph_.automaton().step_s);
  }
  EXPECT_GT(solved, test::num_seeds(40) / 3);
}

TEST_F(OmplControlTest, WhatOmplsOwnPlannerFindsIsAPlanAndCostsNoLess) {
  ompl::RNG::setSeed(1);
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const HorizonProblem problem = test::random_problem(subgraph_, kSteps, random);
    const auto si = make_control_space_information(subgraph_, reachable_, problem);
    const auto definition = std::make_shared<HorizonProblemDefinition>(si, subgraph_, problem);
    oc::RRT rrt(si);
    rrt.setProblemDefinition(definition);
    rrt.setup();
    // Expansions, not time: the same on every machine.
    std::size_t calls = 0;
    rrt.solve(ob::PlannerTerminationCondition([&calls] { return ++calls > 3000; }));
    if (!definition->hasExactSolution()) continue;
    ++solved;
    const auto& path = dynamic_cast<const oc::PathControl&>(*definition->getSolutionPath());
    expect_plan(path, problem, subgraph_, reachable_);
    const double cost_m2 = path_cost(path, *definition->getOptimizationObjective()).value();
    const auto best = make_search_engine(subgraph_, reachable_, {})->search(problem);
    ASSERT_NE(best.status, SearchStatus::kFallback);
    EXPECT_GE(cost_m2, best.cost - 1e-9);
  }
  EXPECT_GT(solved, 2U);
}

TEST_F(OmplControlTest, AnEdgeIntoAnObstacleAndAStepBeyondTheHorizonLeadToNoValidState) {
  HorizonProblem problem;
  problem.start_trim = TrimId{6};
  problem.reference_m.assign(kSteps, Point::Zero());
  const auto reached = [&](std::size_t step) {
    const auto si = make_control_space_information(subgraph_, reachable_, problem);
    ob::State* state = si->allocState();
    oc::Control* control = si->allocControl();
    control->as<oc::DiscreteControlSpace::ControlType>()->value = 0;
    write_state({problem.start, TrimId{0}, step}, *state);
    si->getStatePropagator()->propagate(state, control, 0.2, state);
    const bool is_valid = si->isValid(state);
    si->freeControl(control);
    si->freeState(state);
    return is_valid;
  };
  EXPECT_TRUE(reached(0));
  EXPECT_TRUE(reached(kSteps - 1));
  EXPECT_FALSE(reached(kSteps));
  problem.obstacles_m.assign(kSteps, {});
  problem.obstacles_m[1] = {convex_hull({{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})};
  EXPECT_TRUE(reached(0));
  EXPECT_FALSE(reached(1)) << "step 2 is blocked";
}

}  // namespace
}  // namespace hlc::search
