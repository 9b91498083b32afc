#include "vehicle_sim/tracking/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace hlc {
namespace {

constexpr double kMaxAcceleration_mps2 = 20.0;
constexpr double kMaxCurvature_per_m = 50.0;
constexpr double kMinSpeedForCurvature_mps = 0.1;

bool is_finite(const TrajectoryPoint& point) {
  return std::isfinite(point.x_m) && std::isfinite(point.y_m) && std::isfinite(point.vx_mps) &&
         std::isfinite(point.vy_mps);
}

bool is_drivable(const ReferenceSample& look) {
  // Written so that a value that is not a number is refused.
  if (!(std::abs(look.acceleration_mps2.x()) <= kMaxAcceleration_mps2 &&
        std::abs(look.acceleration_mps2.y()) <= kMaxAcceleration_mps2)) {
    return false;
  }
  return look.velocity_mps.norm() <= kMinSpeedForCurvature_mps ||
         std::abs(look.curvature_per_m()) <= kMaxCurvature_per_m;
}

}  // namespace

double ReferenceSample::curvature_per_m() const {
  const double speed_mps = velocity_mps.norm();
  if (speed_mps == 0.0) {
    return 0.0;
  }
  const double cross =
      velocity_mps.x() * acceleration_mps2.y() - velocity_mps.y() * acceleration_mps2.x();
  return cross / (speed_mps * speed_mps * speed_mps);
}

bool is_well_formed(std::span<const TrajectoryPoint> points) {
  const auto is_not_later = [](const TrajectoryPoint& a, const TrajectoryPoint& b) {
    return b.t <= a.t;
  };
  return std::ranges::all_of(points, [](const TrajectoryPoint& p) { return is_finite(p); }) &&
         std::ranges::adjacent_find(points, is_not_later) == points.end();
}

std::optional<ReferenceSample> sample(std::span<const TrajectoryPoint> points, Nanoseconds t) {
  if (points.size() < 2 || t < points.front().t || t > points.back().t) {
    return std::nullopt;
  }
  const auto end = std::ranges::lower_bound(points.subspan(1), t, {}, &TrajectoryPoint::t);
  const TrajectoryPoint& b = *end;
  const TrajectoryPoint& a = *std::prev(end);

  constexpr double kSecondsPerNanosecond = 1e-9;
  const double T = static_cast<double>(b.t - a.t) * kSecondsPerNanosecond;
  const double u = static_cast<double>(t - a.t) / static_cast<double>(b.t - a.t);
  const Point p0(a.x_m, a.y_m);
  const Point p1(b.x_m, b.y_m);
  const Point m0 = T * Point(a.vx_mps, a.vy_mps);
  const Point m1 = T * Point(b.vx_mps, b.vy_mps);

  ReferenceSample result;
  result.position_m = ((2.0 * u - 3.0) * u * u + 1.0) * p0 + ((u - 2.0) * u + 1.0) * u * m0 +
                      (3.0 - 2.0 * u) * u * u * p1 + (u - 1.0) * u * u * m1;
  result.velocity_mps = (6.0 * (u - 1.0) * u * p0 + ((3.0 * u - 4.0) * u + 1.0) * m0 +
                         6.0 * (1.0 - u) * u * p1 + (3.0 * u - 2.0) * u * m1) /
                        T;
  result.acceleration_mps2 = ((12.0 * u - 6.0) * p0 + (6.0 * u - 4.0) * m0 + (6.0 - 12.0 * u) * p1 +
                              (6.0 * u - 2.0) * m1) /
                             (T * T);
  return result;
}

bool is_followable(std::span<const TrajectoryPoint> points, Nanoseconds t_now) {
  if (points.size() < 2 || !is_well_formed(points) || points.front().t >= t_now + kFirstLook ||
      points.back().t < t_now + kLastLook) {
    return false;
  }
  for (Nanoseconds look = kFirstLook; look <= kLastLook; look += kLookInterval) {
    const std::optional<ReferenceSample> seen = sample(points, t_now + look);
    if (!seen || !is_drivable(*seen)) {
      return false;
    }
  }
  return true;
}

}  // namespace hlc
