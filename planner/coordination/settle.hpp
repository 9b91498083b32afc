#pragma once

#include <span>

#include "planner/coordination/messages.hpp"

namespace hlc {

/// When a new plan comes into force.
///
/// Messages can be lost, so agreement cannot be assumed. Let old_i be the plan of vehicle i in
/// force when step k begins, new_i the one it plans in step k (old_i if it finds none); each
/// vehicle drives one of the two.
///
/// `kStrict`: new_i comes into force only if it is free of old_j and of new_j of every coupled j,
/// both heard. Then whatever subset of the step's messages is lost, the plans in force are free of
/// each other pair by pair, provided that they were so before:
///   * old_i, old_j: free before the step;
///   * new_i, old_j: i has checked new_i against old_j;
///   * new_i, new_j: i has checked new_i against new_j.
/// A vehicle that did not hear both of j keeps old_i, unless new_i stays out of everything j can
/// reach. No vehicle needs to know what another one decided, so no third round of messages is
/// needed for safety. Because every vehicle also plans around the old plans of those that plan
/// after it, old_i stays a solution of its own problem: without a fault, and within its budget, the
/// search always finds a plan.
///
/// All this is about the areas that vehicles tell. That each stays inside its own is the
/// controller's part (planner/controller/controller.hpp); one that was pushed out of them tells so
/// with its next traffic.
///
/// `kAgreed` (the authors', profile `2022`): a new plan respects the new plans of predecessors and
/// the footprints of standing successors only. Who finds none wants to fall back, and then all of
/// its weakly connected component do, trusting that everybody hears of it. Safe only while every
/// vehicle of the component hears every vote before its deadline, and while nobody falls back who
/// has voted for its new plan: a vote that is lost or late leaves two views, and a voter that is
/// itself too late to command its new plan (FallbackReason::kLate) drives its old one, which the
/// others have not kept clear of.
enum class SettleRule { kStrict, kAgreed };

enum class SettleVerdict {
  kInForce,   ///< the new plan comes into force
  kConflict,  ///< it meets the new plan of another vehicle
  kUnheard,   ///< it may meet the new plan of a vehicle that was not heard
  kFallback,  ///< somebody in the component falls back
};

/// What has been heard of a coupled vehicle in this step. Not owned.
struct HeardCoupled {
  const ConvexPolygon* reachable_area_m{};  ///< of its traffic; it was heard, else not coupled
  const OccupiedAreas* predicted{};         ///< of its prediction; nullptr: not heard
};

/// Rule `kStrict`: whether `planned` (of a new plan) comes into force at t(from), as far as the
/// vehicles in `coupled` are concerned. Names the first of them that is in the way.
/// @pre the search has kept the plan free of what every coupled vehicle drives now. Who predicted
/// before the search, so that this was kept free of its prediction too, may be left out.
[[nodiscard]] SettleVerdict settle_strictly(const OccupiedAreas& planned,
                                            std::span<const HeardCoupled> coupled, StepIndex from,
                                            std::size_t steps);

/// Rule `kAgreed`: whether the new plan comes into force, by the votes of the others in the
/// component; nullptr: not heard, which counts as a fallback.
[[nodiscard]] SettleVerdict settle_by_votes(std::span<const Outcome* const> votes);

/// True if, step by step from t(from) until t(from + steps) and standing at the end, the two share
/// no point. Plans that end standing within that time stay free for ever after, since the last area
/// holds the standing footprint. @pre both begin at or before `from`
[[nodiscard]] bool are_free(const OccupiedAreas& a, const OccupiedAreas& b, StepIndex from,
                            std::size_t steps);

/// The same against one area that does not move.
[[nodiscard]] bool are_free(const OccupiedAreas& a, const ConvexPolygon& area_m, StepIndex from,
                            std::size_t steps);

}  // namespace hlc
