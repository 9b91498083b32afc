#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/Path.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>

#include <memory>

#include "planner/search/ompl/ompl_problem.hpp"

namespace hlc::search {

/// The problem for OMPL's kinodynamic planners (ompl/control): the same states (make_state_space),
/// a control for each edge of the subgraph.
///
/// A control is an integer c >= 0. In a state with trim q and j steps done, and m edges that a plan
/// may take there (Subgraph::successors(q, n - j), without those that end near the steering limit
/// if the problem avoids that, and without turning the wheels in place if j > 0), it drives number
/// c mod m of them; for one duration of step_s, no other. Where the edge is not free
/// (CollisionCheck in step j + 1), where there is none, or beyond the horizon the resulting state
/// is out of bounds, hence not valid. So every path of such a planner to a StandstillGoal of the
/// problem is a plan.
///
/// The bounds of positions, from which such planners sample, contain everything that the automaton
/// reaches. For one thread only.
///
/// @param subgraph, reachable, problem  must outlive the space information, `problem` unchanged
[[nodiscard]] std::shared_ptr<ompl::control::SpaceInformation> make_control_space_information(
    const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
    const HorizonProblem& problem);

/// The plan as a path of controls. @pre `si` is of make_control_space_information for this problem
[[nodiscard]] ompl::base::PathPtr make_control_path(
    const std::shared_ptr<ompl::control::SpaceInformation>& si, const HorizonProblem& problem,
    const SearchResult& plan);

/// Sum of the objective's costs of the path's steps: `PathControl::cost` of OMPL 1.5 returns 0.
[[nodiscard]] ompl::base::Cost path_cost(const ompl::control::PathControl& path,
                                         const ompl::base::OptimizationObjective& objective);

}  // namespace hlc::search
