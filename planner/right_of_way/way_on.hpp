#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant.hpp"
#include "planner/right_of_way/grant_order.hpp"

namespace hlc::right_of_way {

/// What a vehicle takes of what is granted to it.
struct Taken {
  double ahead_m{};  ///< end of its authority, from its place
  bool declines{};   ///< it takes less, so that others, or it itself, get on
  /// Others that would be stuck if it took more and are not as it is; none: it itself would be.
  std::vector<VehicleId> declined_for;
  /// It was granted road that is reserved for this one (reservation.hpp).
  std::optional<VehicleId> kept_out_for;

  friend bool operator==(const Taken&, const Taken&) = default;
};

/// Of all ends that are granted (grant.hpp), those that enter no road that is reserved
/// (reservation.hpp), and leave a way on for all vehicles.
///
/// Where lanes are full, vehicles wait for each other around a circle: each for the next one to
/// leave its lane. So a vehicle *declines* to enter a stretch of conflict cells, and ends before
/// it, if more vehicles would be in circles then, or, with as many, more would be stuck, of which
/// it may be the only one.
///
/// This is counted for vehicles that stand at the ends of their authorities, and hold nothing but
/// the cell there. They take turns: all close up along their lanes; then one passes its next
/// stretch, to the first cell behind it, if all these cells are free. Stuck are those that have not
/// passed the three stretches that were their next ones as the step began when no further turn is
/// possible. In a circle are vehicles each of which has another one of them in its way once all
/// have closed up: none of them ever moves again. Several orders of turns are tried (queues.hpp).
///
/// If all have received all, and nobody gives road back, entering closes no circle. Where a turn is
/// possible, the vehicle whose turn is the first one does not decline it, since the other turns are
/// possible after it as before. That nobody is stuck forever does not follow: only some of all
/// orders of turns are tried, and turns end behind three stretches each.
///
/// It takes from what was granted, so no two vehicles hold other overlapping cells whatever each
/// controller has received. Others do not take what was declined before the next step, and come
/// first then (LaneClaim::waiting_steps). Where the order does not put those that wait first, or
/// with more than 30 vehicles, nobody declines, and nothing is reserved.
/// @param ahead_m  grant of these holders
/// @param order    in which they decline
[[nodiscard]] std::vector<Taken> leave_a_way_on(const ConflictMap& map,
                                                std::span<const Holder> holders,
                                                std::span<const double> ahead_m,
                                                std::span<const Blocked> blocked,
                                                const GrantOrder& order = kLongestWait);

}  // namespace hlc::right_of_way
