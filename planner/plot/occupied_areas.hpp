#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/geometry/polygon.hpp"
#include "planner/search/recorded_search.hpp"

namespace hlc::plot {

/// An area that obstacles of a problem occupy, in one step or in several.
struct OccupiedArea {
  ConvexPolygon area_m;
  std::vector<std::size_t> steps;  ///< from 1, sorted
  std::size_t dropped{};           ///< vertices whose edge met this area first
};

/// The obstacles and the boundary of a recorded search, with what they ruled out.
struct OccupiedAreas {
  std::vector<OccupiedArea> areas;  ///< different ones, in the order of steps
  std::size_t dropped_by_boundary{};

  /// "area 3" (its place in the list, from 1) or "the boundary".
  /// @param step  from 1, in which the obstruction is met
  [[nodiscard]] std::string name_of(const search::Obstruction& obstruction, std::size_t step,
                                    const search::HorizonProblem& problem) const;
};

[[nodiscard]] OccupiedAreas occupied_areas(const search::HorizonProblem& problem,
                                           const search::SearchTree& tree);

/// "1-3, 5". @pre sorted, without duplicates
[[nodiscard]] std::string ranges_of(const std::vector<std::size_t>& numbers);

}  // namespace hlc::plot
