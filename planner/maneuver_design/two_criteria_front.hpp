#pragma once

#include "planner/maneuver_design/pareto_front.hpp"
#include "planner/maneuver_design/pareto_subproblems.hpp"

namespace hlc::maneuver_design {

/// Two criteria: the points of an epsilon-constraint front, spaced as in `options`, in order from
/// the optimum of J_2 to that of J_1; see epsilon_constraint_front.
/// @param optima  the ends; the optimum of J_2 may be replaced by a better one
void fill_two_criteria(const ParetoProblem& problem, SingleOptima& optima,
                       const ParetoOptions& options, ParetoFront& front);

}  // namespace hlc::maneuver_design
