#pragma once

#include <limits>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::controller {

/// Where a vehicle's reference ends.
struct ReferenceEnd {
  /// Arc length; no point lies beyond. The end of its authority, or nearer (plan_end.hpp).
  double s_m{std::numeric_limits<double>::infinity()};
  bool is_held_up{};  ///< it gets only there (held_up.hpp), or is to: with that contouring weight
};

/// The reference points that the vehicle has when its plan begins at the pose announced in its
/// traffic: by the reference speed of the options, or the speed limit of the subgraph if that is
/// lower, because a reference that the subgraph cannot follow pulls the plans across the bends; in
/// the route's speed sections not faster than they allow.
/// @param s_m  its place on its route then. Others as below
[[nodiscard]] road::Reference reference_alone(const coordination::Traffic& own,
                                              const RouteTracker& tracker, double s_m,
                                              const automaton::Subgraph& subgraph,
                                              const ControllerOptions& options, double end_s_m);

/// The vehicle on reference points, in the direction of its route; safety margin included.
[[nodiscard]] std::vector<ConvexPolygon> areas_on(const road::Reference& reference,
                                                  const road::ReferencePath& path,
                                                  const vehicle::VehicleParameters& vehicle);

/// The problem of a vehicle without all others: from the pose announced in its traffic, along its
/// route from its place there on, within the corridor as far as it may get.
/// @param reach_m  how far the vehicle can get in a horizon
/// @pre the tracker has selected a route
[[nodiscard]] search::HorizonProblem problem_alone(const coordination::Traffic& own,
                                                   const RouteTracker& tracker,
                                                   const road::Corridor& corridor, double reach_m,
                                                   const automaton::Subgraph& subgraph,
                                                   const ControllerOptions& options,
                                                   const ReferenceEnd& end);

/// The problem one step later, if all vehicles keep to their plans: from the vehicle's next pose,
/// every step's reference and obstacles a step earlier, the last ones extrapolated. Without its
/// incumbent, whose maneuvers may no longer exist.
[[nodiscard]] search::HorizonProblem one_step_later(search::HorizonProblem problem,
                                                    const coordination::Traffic& own);

}  // namespace hlc::controller
