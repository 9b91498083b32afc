#pragma once

#include <string>

#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/scenario/joint_problem_file.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::plot {

/// A picture of a problem and its plan, as SVG: reference points, obstacles of every step,
/// boundary, and of the plan the positions, the swept areas and the footprint after every step.
/// Obstacles and swept areas of one step have one colour, from red (first) to blue (last): only
/// areas of the same colour may not meet.
/// @param result  may be without a plan
[[nodiscard]] std::string problem_plot(const scenario::ProblemFile& file,
                                       const search::SearchResult& result);

/// The same of vehicles that are planned jointly: their swept areas of one colour may not meet
/// either.
[[nodiscard]] std::string joint_problem_plot(const scenario::JointProblemFile& file,
                                             const joint_search::JointSearchResult& result);

}  // namespace hlc::plot
