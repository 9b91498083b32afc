#pragma once

#include <cstddef>
#include <string>

#include "planner/plot/occupied_areas.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/recorded_search.hpp"

/// Pictures of a recorded search as SVG elements of an HTML page, whose style sheet
/// (search_page_style.hpp) has the colours. Both show the same vertices of a large tree
/// (search::vertices_to_show).
namespace hlc::plot {

inline constexpr std::size_t kMostDrawn = 3000;

/// The vertices by depth (to the right) and f (upwards), edges to their parents, the costs of plan
/// and runner-up as lines across. Within a depth they are spread only to be seen. Some with the
/// largest f are drawn at the upper edge.
[[nodiscard]] std::string tree_picture(const search::RecordedSearch& recorded);

/// Reference, boundary and occupied areas with their numbers, the edges of the tree, the plan with
/// its swept areas and the runner-up. Edges are drawn straight from position to position.
[[nodiscard]] std::string search_map(const scenario::ProblemFile& file,
                                     const search::RecordedSearch& recorded,
                                     const OccupiedAreas& occupied);

}  // namespace hlc::plot
