#include "planner/automaton/swept_area.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::automaton {
namespace {

constexpr std::size_t kMaxAreaVertices = 8;
constexpr double kChordError_m = 1e-5;
constexpr double kIntegrationError_m = 1e-6;

/// Yaw of the vehicle for a sampled motion.
enum class Yaw {
  kPlanned,   ///< the planned heading
  kDriven,    ///< that of the identified vehicle, its steering taken as unlimited
  kFullLeft,  ///< that of the identified vehicle at full steering to the left
  kFullRight,
};

/// Angle from the planned heading to the yaw.
double yaw_offset_rad(double steering_rad, Yaw yaw, const vehicle::VehicleParameters& vehicle,
                      const vehicle::IdentifiedVehicle& identified) {
  if (yaw == Yaw::kPlanned) {
    return 0.0;
  }
  double s = vehicle::steady_steering(vehicle::curvature_per_m(steering_rad, vehicle), identified);
  if (yaw != Yaw::kDriven) {
    s = identified.steering_offset + (yaw == Yaw::kFullLeft ? 1.0 : -1.0);
  }
  return vehicle::slip_angle_rad(steering_rad, vehicle) - identified.slip_gain_rad * s -
         identified.slip_offset_rad;
}

/// The driven yaw for this steering.
Yaw driven_yaw(double steering_rad, const vehicle::VehicleParameters& vehicle,
               const vehicle::IdentifiedVehicle& identified) {
  const double s =
      vehicle::steady_servo(vehicle::curvature_per_m(steering_rad, vehicle), identified);
  return s > 1.0 ? Yaw::kFullLeft : s < -1.0 ? Yaw::kFullRight : Yaw::kDriven;
}

/// All driven yaws that occur between two states of one interval: steering changes monotonically
/// there.
std::vector<Yaw> driven_yaws(const vehicle::State& from, const vehicle::State& to,
                             const vehicle::VehicleParameters& vehicle,
                             const vehicle::IdentifiedVehicle& identified) {
  const Yaw first = driven_yaw(from.steering_rad, vehicle, identified);
  const Yaw last = driven_yaw(to.steering_rad, vehicle, identified);
  if (first == last) {
    return {first};
  }
  if (first == Yaw::kDriven || last == Yaw::kDriven) {
    return {first, last};
  }
  return {first, Yaw::kDriven, last};
}

/// Bound on the acceleration of a point of the vehicle at distance `radius_m` from its reference
/// point, between two states of one interval. Letters as in the header.
double acceleration_bound_mps2(const vehicle::State& from, const vehicle::State& to,
                               const vehicle::Input& input, double radius_m, Yaw yaw,
                               const vehicle::VehicleParameters& vehicle,
                               const vehicle::IdentifiedVehicle& identified) {
  const double L = vehicle.wheelbase_m;
  const double q = vehicle.rear_axle_to_cg_m / L;
  const double a = std::abs(input.acceleration_mps2);
  const double w = std::abs(input.steering_rate_radps);
  const double v = std::max(std::abs(from.speed_mps), std::abs(to.speed_mps));
  const double delta = std::max(std::abs(from.steering_rad), std::abs(to.steering_rad));
  const double t = std::tan(delta);
  const double t1 = 1.0 + t * t;

  const double beta1 = q * t1 / (1.0 + q * q * t * t);
  const double kappa = vehicle::curvature_per_m(delta, vehicle);
  const double kappa1 = t1 / L;
  double theta1 = v * kappa;
  double theta2 = a * kappa + v * kappa1 * w;
  if (yaw != Yaw::kPlanned) {
    const double beta2 = 2.0 * q * t * (1.0 - q * q) * t1;
    const double kappa2 = t * t1 * (std::abs(2.0 - 3.0 * q * q) + q * q * t * t) / L;
    const double p3 = std::abs(identified.slip_gain_rad);
    const double s = std::abs(vehicle::steady_steering(kappa, identified));
    const double s1 = identified.path_speed_gain / identified.yaw_rate_gain_per_m;
    const double s2 = 6.0 * std::abs(identified.path_speed_steering) * s * s1 * s1;
    theta1 += (beta1 + p3 * s1 * kappa1) * w;
    theta2 += (beta2 + p3 * (s2 * kappa1 * kappa1 + s1 * kappa2)) * w * w;
  }
  const double chi1 = v * kappa + beta1 * w;
  return std::hypot(a, v * chi1) + radius_m * std::hypot(theta1 * theta1, theta2);
}

/// Appends the footprint's corners at samples of one interval, both ends included, dense enough
/// that no corner strays from the chord between two samples by more than kChordError_m.
void append_corners(const Maneuver& maneuver, std::size_t interval, double margin_m, Yaw yaw,
                    const vehicle::VehicleParameters& vehicle,
                    const vehicle::IdentifiedVehicle& identified, std::vector<Point>& corners_m) {
  const double interval_s = maneuver.duration_s / static_cast<double>(maneuver.inputs.size());
  const ConvexPolygon footprint = footprint_area(vehicle.footprint, Pose{}, margin_m);
  const double radius_m = footprint.vertices_m.front().norm();
  const vehicle::State& from = maneuver.states[interval];
  const vehicle::State& to = maneuver.states[interval + 1];
  const double bound_mps2 = acceleration_bound_mps2(from, to, maneuver.inputs[interval], radius_m,
                                                    yaw, vehicle, identified);
  const double largest_s = std::sqrt(8.0 * kChordError_m / std::max(bound_mps2, 1e-6));
  const double pieces = std::max(1.0, std::ceil(interval_s / largest_s));
  for (double piece = 0.0; piece <= pieces; piece += 1.0) {
    const double time_s = (static_cast<double>(interval) + piece / pieces) * interval_s;
    const vehicle::State state = state_at(maneuver, time_s, vehicle);
    Pose pose = state.pose;
    pose.heading_rad += yaw_offset_rad(state.steering_rad, yaw, vehicle, identified);
    const ConvexPolygon area = transformed(footprint, pose);
    corners_m.insert(corners_m.end(), area.vertices_m.begin(), area.vertices_m.end());
  }
}

ConvexPolygon area_around(std::vector<Point> corners_m) {
  const ConvexPolygon hull = convex_hull(std::move(corners_m));
  return simplified_outwards(inflated(hull, kChordError_m + kIntegrationError_m), kMaxAreaVertices);
}

}  // namespace

SweptAreas swept_areas(const Maneuver& maneuver, const vehicle::VehicleParameters& vehicle,
                       const vehicle::IdentifiedVehicle& identified) {
  std::vector<Point> lane_m;
  std::vector<Point> swept_m;
  const double margin_m = vehicle.safety_margin_m;
  for (std::size_t i = 0; i < maneuver.inputs.size(); ++i) {
    append_corners(maneuver, i, 0.0, Yaw::kPlanned, vehicle, identified, lane_m);
    append_corners(maneuver, i, margin_m, Yaw::kPlanned, vehicle, identified, swept_m);
    for (const Yaw yaw :
         driven_yaws(maneuver.states[i], maneuver.states[i + 1], vehicle, identified)) {
      append_corners(maneuver, i, margin_m, yaw, vehicle, identified, swept_m);
    }
  }
  return {area_around(std::move(swept_m)), area_around(std::move(lane_m))};
}

}  // namespace hlc::automaton
