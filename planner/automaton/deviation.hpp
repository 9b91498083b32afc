#pragma once

#include "planner/automaton/automaton.hpp"

namespace hlc::automaton {

/// Deviation of a measured vehicle from its plan [m]: the largest distance of a point of its
/// footprint from
///
///     H = hull of the footprint at the planned heading and at the corresponding yaw
///
/// (both at the planned position, without margin; yaw = heading + yaw_minus_heading_rad). The
/// distance from a convex set is convex, so it is largest at a corner.
///
/// A swept area contains H moved outwards by the safety margin on all sides, at every time of the
/// motion: the footprint grown by the margin, for both headings, contains all points within the
/// margin of each, and the area is convex. So
///
///     deviation <= safety margin  =>  the vehicle is inside the swept area,
///
/// and the margin is the bound on the deviation, for position and heading together. A vehicle with
/// the right yaw at distance d from its planned position deviates by at most d. One at its planned
/// position but turned by e deviates by about e times half its length: with a margin of m, |e| <= 2
/// m / length is left for the heading.
///
/// @param measured  heading_rad is the vehicle's yaw
[[nodiscard]] double footprint_deviation_m(const Pose& measured, const vehicle::State& planned,
                                           const vehicle::VehicleParameters& vehicle,
                                           const vehicle::IdentifiedVehicle& identified);

/// True if footprint_deviation_m is larger than `limit_m`, decided at once where the vehicle is
/// clearly near: a point of the footprint at distance r from its centre deviates by at most |p -
/// p'| + r |psi - psi'|, where p and psi are measured, p' and psi' the planned position and either
/// heading of H.
[[nodiscard]] bool deviates(const Pose& measured, const vehicle::State& planned, double limit_m,
                            const vehicle::VehicleParameters& vehicle,
                            const vehicle::IdentifiedVehicle& identified);

/// The planner's pose of a vehicle measured at `measured` (yaw) while it steers as planned: same
/// course, hence heading = yaw - yaw_minus_heading_rad. Exact for a vehicle in steady state; after
/// a change of steering the vehicle turns to that yaw within some 0.1 s.
[[nodiscard]] Pose pose_of_measured(const Pose& measured, double steering_rad,
                                    const vehicle::VehicleParameters& vehicle,
                                    const vehicle::IdentifiedVehicle& identified);

}  // namespace hlc::automaton
