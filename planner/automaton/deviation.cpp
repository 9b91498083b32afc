#include "planner/automaton/deviation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/geometry/footprint.hpp"

namespace hlc::automaton {
namespace {

double distance_to_segment_m(const Point& point, const Point& from, const Point& to) {
  const Point way = to - from;
  const double part = std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - from - part * way).norm();
}

double distance_to_area_m(const Point& point, const ConvexPolygon& area) {
  if (contains(area, point)) return 0.0;
  const ConvexPolygon::Vertices& vertices = area.vertices_m;
  double result = (point - vertices.front()).norm();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    result = std::min(
        result, distance_to_segment_m(point, vertices[i], vertices[(i + 1) % vertices.size()]));
  }
  return result;
}

}  // namespace

double footprint_deviation_m(const Pose& measured, const vehicle::State& planned,
                             const vehicle::VehicleParameters& vehicle,
                             const vehicle::IdentifiedVehicle& identified) {
  Pose turned = planned.pose;
  turned.heading_rad += yaw_minus_heading_rad(planned.steering_rad, vehicle, identified);
  const ConvexPolygon hull = convex_hull(std::array{footprint_area(vehicle.footprint, planned.pose),
                                                    footprint_area(vehicle.footprint, turned)});
  double result = 0.0;
  for (const Point& corner : footprint_area(vehicle.footprint, measured).vertices_m) {
    result = std::max(result, distance_to_area_m(corner, hull));
  }
  return result;
}

bool deviates(const Pose& measured, const vehicle::State& planned, double limit_m,
              const vehicle::VehicleParameters& vehicle,
              const vehicle::IdentifiedVehicle& identified) {
  const double radius_m = 0.5 * std::hypot(vehicle.footprint.length_m, vehicle.footprint.width_m);
  const double off_m = (measured.position_m() - planned.pose.position_m()).norm();
  const double turn_rad = wrap_angle(measured.heading_rad - planned.pose.heading_rad);
  const auto is_near = [&](double heading_rad) {
    return off_m + radius_m * std::abs(turn_rad - heading_rad) < limit_m;
  };
  if (is_near(0.0) || is_near(yaw_minus_heading_rad(planned.steering_rad, vehicle, identified))) {
    return false;
  }
  return footprint_deviation_m(measured, planned, vehicle, identified) > limit_m;
}

Pose pose_of_measured(const Pose& measured, double steering_rad,
                      const vehicle::VehicleParameters& vehicle,
                      const vehicle::IdentifiedVehicle& identified) {
  return {measured.x_m, measured.y_m,
          measured.heading_rad - yaw_minus_heading_rad(steering_rad, vehicle, identified)};
}

}  // namespace hlc::automaton
