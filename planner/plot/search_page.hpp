#pragma once

#include <string>

#include "planner/scenario/problem_file.hpp"
#include "planner/search/recorded_search.hpp"

namespace hlc::plot {

/// What was searched for one plan, as one page without scripts that loads nothing: the plan and the
/// runner-up in words, what ruled out the other plans, every first maneuver with its best plan, the
/// vertices by depth, the tree and a map as pictures, and what the terms mean. Light or dark as the
/// browser prefers. Names are escaped. Counts are of all vertices; of a large tree, kMostDrawn are
/// drawn, and the page names the number of the others.
/// @param recorded  of the file's problem with the file's search options
[[nodiscard]] std::string search_page(const scenario::ProblemFile& file,
                                      const search::RecordedSearch& recorded);

}  // namespace hlc::plot
