#pragma once

#include "planner/automaton/automaton.hpp"

namespace hlc::automaton {

/// The two areas that a maneuver covers, see Maneuver.
struct SweptAreas {
  ConvexPolygon swept_area_m;
  ConvexPolygon lane_area_m;
};

/// Convex areas that contain the footprint at *every* time of the motion, with at most 8 vertices
/// each.
///
/// They are the hull of the footprint's corners at samples, moved outwards by a bound on how far a
/// corner strays between two samples, then simplified outwards.
///
/// **The bound.** On a piece of constant input (a, w) = (u_v, u_delta) a corner is
/// c(t) = p(t) + R(theta(t)) r, with p the position, theta the yaw and r the corner in the vehicle.
/// A twice differentiable curve leaves the chord between two of its points, taken a time h apart,
/// by at most
///
///     e = h^2 / 8 max |c''|,
///
/// and the chord lies in the hull of the samples. The footprint is the hull of its corners, so it
/// lies in the hull of the samples moved outwards by e. The samples are taken close enough that e
/// <= 0.01 mm.
///
/// **Bound on c''.** Let v and |delta| stand for their largest values on the piece (both are linear
/// in time, so these are at its ends), t = tan |delta|, q = l_r / L <= 1, and kappa(delta) the
/// curvature, which grows with |delta|. The course is chi = psi + beta, so p' = v (cos chi, sin
/// chi) and
///
///     |p''| <= sqrt(a^2 + (v chi1)^2),       chi1 = v kappa + beta1 |w|   >= |chi'|
///     |(R r)''| <= |r| sqrt(theta1^4 + theta2^2)
///
/// where theta1 and theta2 bound the first and second derivative of the yaw in time. Planned
/// heading:
///
///     theta1 = v kappa,        theta2 = |a| kappa + v kappa1 |w|
///
/// Yaw of the identified vehicle, theta = psi + o(delta) with o = beta - p3 s(kappa) - p10
/// (yaw_minus_heading_rad): theta1 grows by o1 |w| and theta2 by o2 w^2, where
///
///     o1 = beta1 + |p3| s1 kappa1,     o2 = beta2 + |p3| (s2 kappa1^2 + s1 kappa2)
///
/// and the derivatives with respect to delta are bounded by
///
///     beta = atan(q t):                beta1 = q (1+t^2) / (1 + q^2 t^2)   grows with t (q <= 1)
///                                      beta2 = 2 q t (1-q^2) (1+t^2)
///     kappa = t / (L sqrt(1+q^2 t^2)): kappa1 = (1+t^2) / L
///                                      kappa2 = t (1+t^2) (|2-3q^2| + q^2 t^2) / L
///     s(kappa), the inverse of         s1 = p1 / p4
///     p4 s / (p1 (1 + p2 s^2)):        s2 = 6 |p2| |s| (p1 / p4)^2            with p2 <= 0
///
/// (beta2, kappa1 and kappa2 leave out powers of 1 + q^2 t^2 in the denominator; s1 and s2 use that
/// the derivative of the inverted function is at least p4/p1.)
///
/// Where the path is sharper than the identified vehicle can drive, s is that of full steering
/// (steady_slip_rad). There o has a kink, so the unlimited yaw and the yaw at full steering are
/// sampled as two motions, each on the intervals where it occurs; at full steering s1 = s2 = 0, and
/// the bound above holds all the more.
///
/// States between the interval bounds come from a Runge-Kutta step instead of the exact solution; 1
/// um is added for that (its error is below 0.1 um with 20 intervals in 0.2 s).
///
/// @pre `maneuver` has inputs and states; 0 <= l_r <= L, p4 > 0, p2 <= 0
[[nodiscard]] SweptAreas swept_areas(const Maneuver& maneuver,
                                     const vehicle::VehicleParameters& vehicle,
                                     const vehicle::IdentifiedVehicle& identified);

}  // namespace hlc::automaton
