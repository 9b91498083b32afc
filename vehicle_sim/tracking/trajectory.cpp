#include "vehicle_sim/tracking/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "planner/vehicle/lab_limits.hpp"

namespace hlc::tracking {
namespace {

constexpr double kMaxAcceleration_mps2 = 20.0;
constexpr double kMaxCurvature_per_m = 50.0;

bool is_finite(const TrajectoryPoint& point) {
  return std::isfinite(point.x_m) && std::isfinite(point.y_m) && std::isfinite(point.vx_mps) &&
         std::isfinite(point.vy_mps);
}

bool is_drivable(const CurveSample& look) {
  // Written so that NaN is refused.
  if (!(std::abs(look.acceleration_mps2.x()) <= kMaxAcceleration_mps2 &&
        std::abs(look.acceleration_mps2.y()) <= kMaxAcceleration_mps2)) {
    return false;
  }
  return look.velocity_mps.norm() <= vehicle::kMinSpeedForCurvature_mps ||
         std::abs(look.curvature_per_m()) <= kMaxCurvature_per_m;
}

}  // namespace

bool is_well_formed(std::span<const TrajectoryPoint> points) {
  const auto is_not_later = [](const TrajectoryPoint& a, const TrajectoryPoint& b) {
    return b.t <= a.t;
  };
  return std::ranges::all_of(points, [](const TrajectoryPoint& p) { return is_finite(p); }) &&
         std::ranges::adjacent_find(points, is_not_later) == points.end();
}

std::optional<CurveSample> sample(std::span<const TrajectoryPoint> points, Nanoseconds t) {
  if (points.size() < 2 || t < points.front().t || t > points.back().t) {
    return std::nullopt;
  }
  const auto end = std::ranges::lower_bound(points.subspan(1), t, {}, &TrajectoryPoint::t);
  const TrajectoryPoint& b = *end;
  const TrajectoryPoint& a = *std::prev(end);

  constexpr double kSecondsPerNanosecond = 1e-9;
  const double T = static_cast<double>(b.t - a.t) * kSecondsPerNanosecond;
  const double u = static_cast<double>(t - a.t) / static_cast<double>(b.t - a.t);
  const auto point = [](const TrajectoryPoint& p) {
    return TimedPoint{.position_m = {p.x_m, p.y_m}, .velocity_mps = {p.vx_mps, p.vy_mps}};
  };
  return interpolated(point(a), point(b), T, u);
}

bool is_followable(std::span<const TrajectoryPoint> points, Nanoseconds t_now) {
  if (points.size() < 2 || !is_well_formed(points) || points.front().t >= t_now + kFirstLook ||
      points.back().t < t_now + kLastLook) {
    return false;
  }
  for (Nanoseconds look = kFirstLook; look <= kLastLook; look += kLookInterval) {
    const std::optional<CurveSample> seen = sample(points, t_now + look);
    if (!seen || !is_drivable(*seen)) {
      return false;
    }
  }
  return true;
}

}  // namespace hlc::tracking
