#pragma once

#include <optional>

#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// The problem of driving off from where a plan ends, along the path, while those beside it stay
/// where they are in the last step of the plan's problem; none if nobody is beside it.
///
/// A vehicle that stops beside another one, or between it and a kerb, may find that every first
/// maneuver of its automaton touches one of them, by some millimetres. Then neither it nor those
/// that wait for it get on. So with right of way no plan ends in such a place, except where the
/// plan in force ends, which is to stay a plan to fall back on, or if there is no way off from its
/// end either.
///
/// Left out are those on the path ahead, for which the vehicle waits anyway and which drive on
/// before it does, the bar at the end of its authority among them, and guests. Alone it has a way
/// off from nearly everywhere (`Controller::find_nearer_end`). That another vehicle may stop beside
/// it later, and take its way off, is not looked at.
/// @param found_in  the problem in which the plan was found
/// @param next      the plan is known from t(next) on
/// @param tracker   has selected a route
/// @param reach_m   as for RouteTracker::project
[[nodiscard]] std::optional<search::HorizonProblem> way_off_problem(
    const coordination::Plan& plan, const search::HorizonProblem& found_in, StepIndex next,
    const RouteTracker& tracker, double reach_m, const vehicle::VehicleParameters& vehicle);

/// Whether the path found for that problem leads away from its start. True also if the search has
/// stopped early.
[[nodiscard]] bool may_lead_off(const search::SearchResult& result,
                                const search::HorizonProblem& way_off,
                                const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::controller
