#pragma once

#include <cstddef>
#include <span>

#include "planner/coordination/messages.hpp"

namespace hlc::coordination {

enum class CommitVerdict {
  kInForce,      ///< the new plan comes into force
  kConflict,     ///< the plan meets the new plan of another vehicle
  kNotReceived,  ///< the plan may meet the new plan of a vehicle that was not received
  kFallback,     ///< a vehicle of the component falls back
};

/// Messages received from a coupled vehicle in this step. Not owned.
struct CoupledAreas {
  const ConvexPolygon*
      reachable_area_m{};            ///< of its traffic; without it the vehicle is not coupled
  const OccupiedAreas* predicted{};  ///< of its prediction; nullptr: not received
};

/// Inputs of a commit rule. Not owned.
struct CommitInputs {
  const OccupiedAreas* planned{};  ///< of the new plan
  /// @pre the search has kept the plan free of the areas that every coupled vehicle drives now.
  /// Vehicles whose prediction arrived before the search, so that the plan is free of it, too, may
  /// be omitted.
  std::span<const CoupledAreas> coupled{};
  /// Of the others in the component; nullptr: not received. Only for a rule that needs votes.
  std::span<const Outcome* const> votes{};
  StepIndex from;       ///< the plan would come into force at t(from)
  std::size_t steps{};  ///< horizon
};

/// When a new plan comes into force.
///
/// Messages can be lost, so agreement cannot be assumed. Let old_i be the plan of vehicle i in
/// force when step k begins, new_i the one it plans in step k (old_i if it finds none); each
/// vehicle drives one of the two.
///
/// `strict`: new_i comes into force only if it is free of old_j and of new_j of every coupled j,
/// both received. Then whatever subset of the step's messages is lost, the plans in force are free
/// of each other pair by pair, provided that they were so before:
///   * old_i, old_j: free before the step;
///   * new_i, old_j: i has checked new_i against old_j;
///   * new_i, new_j: i has checked new_i against new_j.
/// A vehicle that did not receive both of j keeps old_i, unless new_i stays out of everything j can
/// reach. No vehicle needs to know what another one decided, so no third round of messages is
/// needed for safety. Because every vehicle also plans around the old plans of those that plan
/// after it, old_i stays a solution of its own problem: without a fault, and within its budget, the
/// search always finds a plan. What it does not ensure is that anybody gets on: a vehicle is
/// stopped by the plans in force of those that plan after it (see controller/making_room.hpp).
///
/// All this refers to the areas that vehicles announce. The controller ensures that its vehicle
/// stays inside its announced areas (planner/controller/plan_in_force.hpp); a vehicle that was
/// pushed out of them announces this with its next traffic.
///
/// `agreed` (the authors', profile `2022`): a new plan respects only the new plans of predecessors
/// and the footprints of standing successors. A vehicle without a plan votes for a fallback, and
/// then all vehicles of its weakly connected component fall back, assuming that all receive the
/// vote. Safe only while every vehicle of the component receives every vote before its deadline,
/// and while no vehicle falls back that has voted for its new plan: a vote that is lost or late
/// leaves two views, and a voter that is too late to command its new plan (FallbackReason::kLate)
/// drives its old one, which the others have not kept clear of.
///
/// Each rule requires the matching obstacles in planning (planner/controller/obstacles.hpp).
struct CommitRule {
  /// False: the rule uses the predictions of the coupled vehicles. True: the outcomes of the
  /// component, a third round of messages.
  bool needs_votes{};
  CommitVerdict (*decide)(const CommitInputs& inputs){};
  friend bool operator==(const CommitRule&, const CommitRule&) = default;
};

/// Rule `strict`. Its verdict names the first coupled vehicle that blocks the plan.
[[nodiscard]] CommitVerdict commit_strictly(const CommitInputs& inputs);
/// Rule `agreed`. A vote that was not received counts as a fallback.
[[nodiscard]] CommitVerdict commit_by_votes(const CommitInputs& inputs);

inline constexpr CommitRule kStrictCommit{.needs_votes = false, .decide = &commit_strictly};
inline constexpr CommitRule kAgreedCommit{.needs_votes = true, .decide = &commit_by_votes};

/// True if, step by step from t(from) until t(from + steps) and standing at the end, the two share
/// no point. Plans that end standing within that time stay free forever after, since the last area
/// contains the standing footprint. @pre both begin at or before `from`
[[nodiscard]] bool are_free(const OccupiedAreas& a, const OccupiedAreas& b, StepIndex from,
                            std::size_t steps);

/// The same against one area that does not move.
[[nodiscard]] bool are_free(const OccupiedAreas& a, const ConvexPolygon& area_m, StepIndex from,
                            std::size_t steps);

}  // namespace hlc::coordination
