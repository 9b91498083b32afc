#pragma once

#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// Most that a vehicle with right of way may stand askew in its lane. The cost of a plan knows
/// positions only: a vehicle whose way is blocked would turn its front into the next lane to get
/// some millimetres nearer to its reference, and from there it may have no way on, and nor have
/// those behind it. In bends vehicles end turned by up to 0.16 rad, where they straighten their
/// wheels while they brake.
inline constexpr double kMostTurned_rad = 0.25;

/// Arc length of the place on the path where the plan ends, counted on from the tracker's.
/// @param next     the plan is known from t(next) on
/// @param tracker  has selected a route
/// @param reach_m  as for RouteTracker::project
[[nodiscard]] double end_s_m(const coordination::Plan& plan, StepIndex next,
                             const RouteTracker& tracker, double reach_m);

/// Angle between the vehicle where the plan ends and the path at its place there, in [0, pi].
/// Parameters as for `end_s_m`.
[[nodiscard]] double turned_at_end_rad(const coordination::Plan& plan, StepIndex next,
                                       const RouteTracker& tracker, double reach_m);

/// Whether the candidate ends turned by at most kMostTurned_rad, or by no more than the plan in
/// force (a vehicle that stands askew already may straighten in several plans). The plan in force
/// itself satisfies this, so it stays a plan to fall back on, and a plan that does not can be
/// dropped. In its place the controller searches plans whose references end nearer, because from
/// some places in bends each optimal plan with few trims ends askew. No exception for plans that
/// lead on: the vehicle drives to the end of one where messages are lost.
/// @param next  from t(next) on the candidate would be driven
[[nodiscard]] bool ends_along_lane(const coordination::Plan& candidate,
                                   const coordination::Plan& in_force, StepIndex next,
                                   const RouteTracker& tracker, double reach_m);

}  // namespace hlc::controller
