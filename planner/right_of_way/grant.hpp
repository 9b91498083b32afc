#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant_order.hpp"

namespace hlc::right_of_way {

/// An area of a vehicle that holds no cells: off the road, or without a controller; or of an
/// obstacle.
struct Blocked {
  std::optional<VehicleId> vehicle;  ///< none: an obstacle that is no vehicle
  ConvexPolygon area_m;
  friend bool operator==(const Blocked&, const Blocked&) = default;
};

/// How far every vehicle's authority reaches after all that can be granted has been: the ends of
/// `holders`, from their places [m], in the same order.
///
/// The first vehicle comes first by `order`, then the one with the smaller id. Its authority is
/// extended cell by cell, up to `look_ahead_m` from its place, while the next cell overlaps no cell
/// that another vehicle holds and nothing that one blocks; a stretch of conflict cells only as a
/// whole, with the first cell behind it that is none. Behind a vehicle ahead it ends at that one's
/// present place, not where it is going to be.
///
/// Places can overlap already: at a start, or at a merge that two vehicles have entered because
/// messages were lost. Of two such vehicles neither would be granted anything, since each next cell
/// overlaps the other's place. So the place of the one behind is free for the one that is ahead:
/// that has less far to drive until it does not overlap the other's place, then the smaller id.
///
/// A pure function of what all vehicles announced: controllers that received the same compute the
/// same, without a further message. It never takes a cell from a vehicle. A controller that has not
/// received all of them must not take what is granted here (cautious_grant).
///
/// What this is for: no authority ends in a cell that a vehicle of another lane needs. A vehicle
/// that is held up on its way may still stop in one. Around a circle of full lanes vehicles would
/// wait for each other: not all of what is granted is taken (way_on.hpp).
[[nodiscard]] std::vector<double> grant(const ConflictMap& map, std::span<const Holder> holders,
                                        std::span<const Blocked> blocked, double look_ahead_m,
                                        const GrantOrder& order = kLongestWait);

/// A vehicle of which nothing has been received in this step.
struct Missing {
  Holder last;       ///< as it was last received
  double moved_m{};  ///< the longest way that it can have driven since then
};

/// For a controller that has not received all: all vehicles with what each may hold at the end of
/// this step, whatever it has received, and the vehicle `own` with what it takes: cells outside of
/// all that. None if no missing vehicle can change what `grant` gives to `own`: then it takes that.
///
/// So no two vehicles hold overlapping cells, whatever is lost, but those whose places overlap
/// already, of which one gets on. By induction, let no others do at first. The *reach* of a vehicle
/// is what it may hold at the end of the step: the cells up to its look-ahead that none of those
/// that were received holds, but at a place that it overlaps.
/// * A vehicle takes cells in its reach only. So does a missing one: what it has taken since it was
///   last received was free when it took it, and those that were received hold theirs still, or
///   hold only cells behind it that it has left, up to `moved_m`.
/// * Those that have received all take the result of `grant`, the same for all and without overlap.
/// * What `grant` gives to a vehicle depends only on those whose reaches are connected with its own
///   by overlaps, and these are the same or fewer for who knows more. So who has received all of
///   those takes the result of `grant` with the others.
/// * Everybody else takes only what is in nobody's reach.
///
/// Assumed: places move by at most `moved_m`, plans end in cells that were granted, and what blocks
/// is the same for all. It is not where only some consider a vehicle gone, or never received it.
/// @pre `own` is one of `holders`, none of `missing`
[[nodiscard]] std::optional<std::vector<Holder>> cautious_grant(const ConflictMap& map,
                                                                std::span<const Holder> holders,
                                                                std::span<const Missing> missing,
                                                                std::span<const Blocked> blocked,
                                                                double look_ahead_m, VehicleId own);

/// The vehicles that hold or block cells of what would be granted next to the vehicle with this
/// index, in the order of `holders`, then of `blocked`.
[[nodiscard]] std::vector<VehicleId> withheld_by(const ConflictMap& map,
                                                 std::span<const Holder> holders,
                                                 std::span<const Blocked> blocked, std::size_t who);

}  // namespace hlc::right_of_way
