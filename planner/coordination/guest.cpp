#include "planner/coordination/guest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/geometry/pose.hpp"

namespace hlc::coordination {
namespace {

using std::numbers::pi;

/// Lengths of path that a guest can have driven.
struct Travel {
  double low_m;
  double high_m;
};

double shortest_m(double speed_mps, double deceleration_mps2, double time_s) {
  const double braking_s = std::min(time_s, speed_mps / deceleration_mps2);
  return speed_mps * braking_s - 0.5 * deceleration_mps2 * braking_s * braking_s;
}

double longest_m(double speed_mps, const GuestLimits& limits, double time_s) {
  const double gained_mps = std::max(0.0, limits.speed_mps - speed_mps);
  const double accelerating_s = std::min(time_s, gained_mps / limits.acceleration_mps2);
  return speed_mps * time_s +
         limits.acceleration_mps2 * accelerating_s * (time_s - 0.5 * accelerating_s);
}

Travel travel_of(const GuestLimits& limits, double speed_mps, double error_mps, double from_s,
                 double to_s) {
  return {
      .low_m = shortest_m(std::max(0.0, speed_mps - error_mps), limits.deceleration_mps2, from_s),
      .high_m = longest_m(std::max(0.0, speed_mps) + error_mps, limits, to_s)};
}

/// h of the header. @param direction_rad  from 0 to pi
double farthest_m(double direction_rad, double length_m, double curvature_per_m) {
  const double turned_rad = curvature_per_m * length_m;
  const double sine = std::sin(direction_rad);
  if (turned_rad >= direction_rad) return (sine + turned_rad - direction_rad) / curvature_per_m;
  return (sine - std::sin(direction_rad - turned_rad)) / curvature_per_m;
}

/// How far a rectangle at any heading within `turn_rad` of 0 extends in a direction.
double extent_m(const Footprint& footprint, double direction_rad, double turn_rad) {
  const double to_corner_rad = std::atan2(footprint.width_m, footprint.length_m);
  const std::array corners_rad{to_corner_rad, -to_corner_rad, pi - to_corner_rad,
                               to_corner_rad - pi};
  const bool a_corner_points_there = std::ranges::any_of(corners_rad, [&](double corner_rad) {
    return std::abs(wrap_angle(direction_rad - corner_rad)) <= turn_rad;
  });
  if (a_corner_points_there) return 0.5 * std::hypot(footprint.length_m, footprint.width_m);
  const auto extent_at = [&footprint](double angle_rad) {
    return 0.5 * (footprint.length_m * std::abs(std::cos(angle_rad)) +
                  footprint.width_m * std::abs(std::sin(angle_rad)));
  };
  return std::max(extent_at(direction_rad - turn_rad), extent_at(direction_rad + turn_rad));
}

}  // namespace

ConvexPolygon reachable_area(const Guest& guest, const MeasuredVehicle& measured, double from_s,
                             double to_s, const GuestErrors& errors) {
  constexpr int kSides = 16;
  constexpr double kBetween_rad = 2.0 * pi / kSides;
  const double curvature_per_m = guest.limits.curvature_per_m;
  // A lead is known of our vehicles only: the pose is that of any time up to it.
  const Travel travel = travel_of(guest.limits, measured.speed_mps, errors.speed_mps,
                                  std::max(0.0, measured.age_s - measured.pose_lead_s + from_s),
                                  std::max(0.0, measured.age_s + to_s));
  const Footprint with_margin{guest.footprint.length_m + 2.0 * guest.safety_margin_m,
                              guest.footprint.width_m + 2.0 * guest.safety_margin_m};
  const double turn_rad = errors.course_rad + curvature_per_m * travel.high_m;
  const auto distance_m = [&](double direction_rad) {
    const double beside_rad =
        std::max(0.0, std::abs(wrap_angle(direction_rad)) - errors.course_rad);
    return std::max(farthest_m(beside_rad, travel.low_m, curvature_per_m),
                    farthest_m(beside_rad, travel.high_m, curvature_per_m)) +
           extent_m(with_margin, direction_rad, turn_rad) + errors.position_m;
  };
  // Neighbouring sides n_i . p = d_i meet at the corner; of three that meet there, two are one.
  std::vector<Point> corners_m;
  const double sine = std::sin(kBetween_rad);
  const double cosine = std::cos(kBetween_rad);
  for (int i = 0; i < kSides; ++i) {
    const double side_rad = kBetween_rad * i;
    const double side_m = distance_m(side_rad);
    const double along_m = (distance_m(side_rad + kBetween_rad) - side_m * cosine) / sine;
    const double yaw_rad = measured.pose.heading_rad + side_rad;
    corners_m.push_back(measured.pose.position_m() +
                        side_m * Point(std::cos(yaw_rad), std::sin(yaw_rad)) +
                        along_m * Point(-std::sin(yaw_rad), std::cos(yaw_rad)));
  }
  return convex_hull(std::move(corners_m));
}

}  // namespace hlc::coordination
