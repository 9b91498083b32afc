#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/right_of_way/conflict_map.hpp"

namespace hlc::right_of_way {

/// Number of the conflict zone of every cell, by the cell's number in the map; 0: no conflict cell.
/// A zone is a set of conflict cells that are connected by overlaps. Zones count from 1, in the
/// order in which the routes pass them.
///
/// For people only, who need a name for a place: cars are granted cells, not zones, and several
/// cars may hold parts of one zone.
[[nodiscard]] std::vector<std::uint32_t> conflict_zones(const ConflictMap& map);

/// Number of the zone in the cell behind the one at this arc length; 0: none.
[[nodiscard]] std::uint32_t zone_behind(const ConflictMap& map, std::size_t route, double s_m);

}  // namespace hlc::right_of_way
