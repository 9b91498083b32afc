#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "planner/right_of_way/grant.hpp"

/// Cells of a conflict map, counted by arc lengths.
namespace hlc::right_of_way {

inline std::int64_t cell_at(const ConflictMap& map, std::size_t route, double s_m) {
  return std::llround(s_m / map.cell_m(route));
}

inline std::size_t on_route(const ConflictMap& map, std::size_t route, std::int64_t cell) {
  const auto count = static_cast<std::int64_t>(map.num_cells(route));
  return static_cast<std::size_t>((cell % count + count) % count);
}

/// From `from_m` to `to_m` ahead of the place, both included.
inline std::vector<std::size_t> cells_of(const ConflictMap& map, const Holder& holder,
                                         double from_m, double to_m) {
  const std::size_t route = holder.claim.route;
  std::vector<std::size_t> cells;
  for (std::int64_t cell = cell_at(map, route, holder.claim.place_m + from_m);
       cell <= cell_at(map, route, holder.claim.place_m + to_m); ++cell) {
    cells.push_back(on_route(map, route, cell));
  }
  return cells;
}

inline bool hold_overlapping_cells(const ConflictMap& map, const Holder& a, const Holder& b) {
  const std::vector<std::size_t> others = cells_of(map, b, 0.0, b.claim.ahead_m);
  return std::ranges::any_of(cells_of(map, a, 0.0, a.claim.ahead_m), [&](std::size_t i) {
    return std::ranges::any_of(others, [&](std::size_t j) {
      return std::ranges::binary_search(map.overlaps(a.claim.route, i), map.cell(b.claim.route, j));
    });
  });
}

}  // namespace hlc::right_of_way
