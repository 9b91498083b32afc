#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "planner/right_of_way/conflict_map.hpp"

namespace hlc::right_of_way {

/// Where a vehicle of this route may stop next: the end of a *stretch*, which is `first` itself or
/// the first cell behind a row of conflict cells.
/// @param first  of its cells, counted on over the end of the route
/// @param visit  called with the index of each cell of the stretch, its end included, while it
///               returns true
/// @return none: it has returned false, or a vehicle of this route may stop nowhere
template <class Visit>
[[nodiscard]] std::optional<std::int64_t> end_of_stretch(const ConflictMap& map, std::size_t route,
                                                         std::int64_t first, const Visit& visit) {
  const auto whole_route = static_cast<std::int64_t>(map.num_cells(route));
  for (std::int64_t cell = first; cell < first + whole_route; ++cell) {
    const std::size_t index = map.index_of(route, cell);
    if (!visit(index)) return std::nullopt;
    if (!map.is_conflict(route, index)) return cell;
  }
  return std::nullopt;
}

}  // namespace hlc::right_of_way
