#include "planner/search/ompl/ompl_problem.hpp"

#include <ompl/base/spaces/DiscreteStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/util/Console.h>

#include <memory>
#include <numbers>

namespace ob = ompl::base;

namespace hlc::search {
namespace {

/// Indices of the subspaces.
constexpr unsigned kPose = 0;
constexpr unsigned kTrim = 1;
constexpr unsigned kStep = 2;

}  // namespace

ob::StateSpacePtr make_state_space(const automaton::Subgraph& subgraph, std::size_t max_steps,
                                   const PositionBounds& box) {
  ompl::msg::noOutputHandler();
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);

  const auto pose = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  for (const unsigned axis : {0U, 1U}) {
    bounds.setLow(axis, box.low_m[axis]);
    bounds.setHigh(axis, box.high_m[axis]);
  }
  pose->setBounds(bounds);
  const auto num_trims = static_cast<int>(subgraph.automaton().trims.size());

  const auto space = std::make_shared<ob::CompoundStateSpace>();
  space->addSubspace(pose, 1.0);
  space->addSubspace(std::make_shared<ob::DiscreteStateSpace>(0, num_trims - 1), 0.0);
  space->addSubspace(std::make_shared<ob::DiscreteStateSpace>(0, static_cast<int>(max_steps)), 0.0);
  space->lock();
  return space;
}

ob::SpaceInformationPtr make_space_information(const automaton::Subgraph& subgraph,
                                               std::size_t max_steps) {
  auto si = std::make_shared<ob::SpaceInformation>(make_state_space(subgraph, max_steps));
  si->setStateValidityChecker(std::make_shared<ob::AllValidStateValidityChecker>(si));
  si->setup();
  return si;
}

void write_state(const HorizonState& from, ob::State& to) {
  auto& state = *to.as<ob::CompoundState>();
  auto& pose = *state.as<ob::SE2StateSpace::StateType>(kPose);
  pose.setXY(from.pose.x_m, from.pose.y_m);
  const double heading = wrap_angle(from.pose.heading_rad);
  pose.setYaw(heading < std::numbers::pi ? heading : -std::numbers::pi);  // OMPL: [-pi, pi)
  state.as<ob::DiscreteStateSpace::StateType>(kTrim)->value = static_cast<int>(from.trim.index);
  state.as<ob::DiscreteStateSpace::StateType>(kStep)->value = static_cast<int>(from.step);
}

HorizonState read_state(const ob::State& from) {
  const auto& state = *from.as<ob::CompoundState>();
  const auto& pose = *state.as<ob::SE2StateSpace::StateType>(kPose);
  const int trim = state.as<ob::DiscreteStateSpace::StateType>(kTrim)->value;
  const int step = state.as<ob::DiscreteStateSpace::StateType>(kStep)->value;
  return {{pose.getX(), pose.getY(), pose.getYaw()},
          {static_cast<std::size_t>(trim)},
          static_cast<std::size_t>(step)};
}

StandstillGoal::StandstillGoal(const ob::SpaceInformationPtr& si,
                               const automaton::Subgraph& subgraph, const HorizonProblem& problem,
                               double radius_m)
    : Goal(si), subgraph_(subgraph), problem_(&problem), radius_m_(radius_m) {}

bool StandstillGoal::isSatisfied(const ob::State* state) const {
  const HorizonState reached = read_state(*state);
  if (reached.step != problem_->horizon_steps() ||
      !subgraph_.automaton().trims[reached.trim.index].is_equilibrium()) {
    return false;
  }
  return problem_->reference_m.empty() ||
         (reached.pose.position_m() - problem_->reference_m.back()).norm() <= radius_m_;
}

SquaredDistanceObjective::SquaredDistanceObjective(const ob::SpaceInformationPtr& si,
                                                   const HorizonProblem& problem)
    : OptimizationObjective(si), problem_(&problem) {
  description_ = "sum of squared distances to the reference points";
}

ob::Cost SquaredDistanceObjective::stateCost(const ob::State* state) const {
  const HorizonState reached = read_state(*state);
  if (reached.step == 0 || reached.step > problem_->horizon_steps()) return identityCost();
  return ob::Cost(problem_->position_cost_m2(reached.step - 1, reached.pose.position_m()));
}

ob::Cost SquaredDistanceObjective::motionCost(const ob::State* /*from*/,
                                              const ob::State* to) const {
  return stateCost(to);
}

HorizonProblemDefinition::HorizonProblemDefinition(const ob::SpaceInformationPtr& si,
                                                   const automaton::Subgraph& subgraph,
                                                   const HorizonProblem& problem)
    : ProblemDefinition(si),
      standstill_(std::make_shared<StandstillGoal>(si, subgraph, problem)),
      distances_(std::make_shared<SquaredDistanceObjective>(si, problem)) {
  ob::State* start = si->allocState();
  write_state({problem.start, problem.start_trim, 0}, *start);
  startStates_.push_back(start);  // addStartState would make a copy, which takes as long again
  setGoal(standstill_);
  setOptimizationObjective(distances_);
}

void HorizonProblemDefinition::pose(const HorizonProblem& problem) {
  write_state({problem.start, problem.start_trim, 0}, *startStates_.front());
  standstill_->pose(problem);
  distances_->pose(problem);
  clearSolutionPaths();
  clearSolutionNonExistenceProof();
}

}  // namespace hlc::search
