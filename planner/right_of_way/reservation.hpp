#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant.hpp"
#include "planner/right_of_way/grant_order.hpp"

namespace hlc::right_of_way {

/// Ends of authorities without the road that is kept free for one vehicle.
struct Reserved {
  std::vector<double> ahead_m;  ///< from their places, in the order of the holders
  /// The vehicle for which road is kept free, and indices of those that would have been granted it.
  std::optional<VehicleId> vehicle;
  std::vector<std::size_t> kept_out;
};

/// For each cell of the map, whether it overlaps one of the stretch that would be granted next to
/// this vehicle (stretch.hpp).
[[nodiscard]] std::vector<bool> overlapping_next_stretch(const ConflictMap& map,
                                                         const coordination::LaneClaim& claim);

/// Of all ends that are granted (grant.hpp), those that keep the next stretch of a vehicle free.
///
/// A stretch of conflict cells is granted only as a whole. On a full road that of a vehicle which
/// crosses many lanes may never be free as a whole: others need less of it, and are granted their
/// parts one after the other, however long it has waited. So when it has stood for 50 steps its
/// next stretch is *reserved*: those that come after it in the order are granted no cell that
/// overlaps one of it. Who is in such a cell already drives on.
///
/// One that is in the way may itself need road that is reserved before it can leave. So it is
/// reserved only if turns (queues.hpp) in which nobody enters it lead to its being free, and no
/// more vehicles are stuck after them. In a step it is reserved for one vehicle only, the first one
/// in the order for which that keeps anybody out: what is reserved for two may keep each in the
/// other's way.
///
/// Cells do not know of a vehicle that may go on but finds no plan, perhaps until one that is kept
/// out has left. So nothing is reserved for who has stood for 150 steps. As all of a knot come to
/// stand for so long, the others get on as if nothing were ever reserved.
/// @param ahead_m  grant of these holders
[[nodiscard]] Reserved reserve(const ConflictMap& map, std::span<const Holder> holders,
                               std::span<const double> ahead_m, std::span<const Blocked> blocked,
                               const GrantOrder& order);

}  // namespace hlc::right_of_way
