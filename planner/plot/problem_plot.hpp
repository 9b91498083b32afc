#pragma once

#include <string>

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

}  // namespace hlc::plot
