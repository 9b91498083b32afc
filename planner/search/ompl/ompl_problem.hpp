#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// A state of the OMPL state space SE(2) x trim x step: pose, trim and number of steps done.
struct HorizonState {
  Pose pose;  ///< OMPL keeps the heading in [-pi, pi)
  TrimId trim;
  std::size_t step{};
};

/// A box of positions [m].
struct PositionBounds {
  Point low_m{Point::Constant(-1e4)};  ///< wider than any lab
  Point high_m{Point::Constant(1e4)};
};

/// Compound of SE2StateSpace, DiscreteStateSpace (trims, from 0) and DiscreteStateSpace (0 ...
/// max_steps), locked. The distance of two states is that of their poses. The bounds are for the
/// sampling of OMPL's planners; RecedingHorizonPlanner does not sample.
///
/// Turns OMPL's own console log off, for the whole process.
[[nodiscard]] ompl::base::StateSpacePtr make_state_space(const automaton::Subgraph& subgraph,
                                                         std::size_t max_steps,
                                                         const PositionBounds& bounds = {});

/// That space, set up. Obstacles concern maneuvers, not states: every state is valid and
/// `ompl::base::Path::check` does not check for collision (ompl_control.hpp does).
[[nodiscard]] ompl::base::SpaceInformationPtr make_space_information(
    const automaton::Subgraph& subgraph, std::size_t max_steps);

void write_state(const HorizonState& from, ompl::base::State& to);
[[nodiscard]] HorizonState read_state(const ompl::base::State& state);

/// Goal: the last step of the horizon, in an equilibrium trim, not farther than `radius_m` from the
/// last reference point. It contains the whole problem, so that RecedingHorizonPlanner solves every
/// problem definition with this goal, whatever its origin.
class StandstillGoal final : public ompl::base::Goal {
 public:
  /// @param subgraph  must outlive this object
  /// @param problem   must stay alive and unchanged as long as this object poses it
  StandstillGoal(const ompl::base::SpaceInformationPtr& si, const automaton::Subgraph& subgraph,
                 const HorizonProblem& problem,
                 double radius_m = std::numeric_limits<double>::infinity());
  bool isSatisfied(const ompl::base::State* state) const override;
  [[nodiscard]] const HorizonProblem& problem() const { return *problem_; }
  /// Changes the problem of this goal.
  void pose(const HorizonProblem& problem) { problem_ = &problem; }

 private:
  const automaton::Subgraph& subgraph_;
  const HorizonProblem* problem_;
  double radius_m_;
};

/// Cost of a path: sum of HorizonProblem::position_cost_m2 of the positions after step j = 1 ... n
/// [m^2].
class SquaredDistanceObjective final : public ompl::base::OptimizationObjective {
 public:
  /// @param problem  must stay alive as long as this object measures by it
  SquaredDistanceObjective(const ompl::base::SpaceInformationPtr& si,
                           const HorizonProblem& problem);
  /// Changes the problem.
  void pose(const HorizonProblem& problem) { problem_ = &problem; }
  /// The cost term of the state's step; 0 for the start and beyond the horizon.
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  /// The term of the step that ends in `to`.
  ompl::base::Cost motionCost(const ompl::base::State* from,
                              const ompl::base::State* to) const override;

 private:
  const HorizonProblem* problem_;
};

/// A horizon problem in OMPL's terms: start state, StandstillGoal, SquaredDistanceObjective.
class HorizonProblemDefinition final : public ompl::base::ProblemDefinition {
 public:
  /// @param subgraph  must outlive this object
  /// @param problem   must stay alive and unchanged as long as this object poses it
  HorizonProblemDefinition(const ompl::base::SpaceInformationPtr& si,
                           const automaton::Subgraph& subgraph, const HorizonProblem& problem);
  /// Poses another problem of the same subgraph, without solutions: making a definition takes
  /// longer than many a search. A planner with this definition must be cleared.
  void pose(const HorizonProblem& problem);

 private:
  std::shared_ptr<StandstillGoal> standstill_;
  std::shared_ptr<SquaredDistanceObjective> distances_;
};

}  // namespace hlc::search
