#include "planner/vehicle/lab_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::vehicle {
namespace {

constexpr int kParts = 10;

// All comparisons are written so that a NaN is a fault.

std::optional<FoundFault> segment_fault(const TimedPoint& a, const TimedPoint& b,
                                        const LabLimits& limits) {
  const double duration_s = b.time_s - a.time_s;
  const Eigen::Vector2d mismatch =
      (b.position_m - a.position_m) / duration_s - 0.5 * (a.velocity_mps + b.velocity_mps);
  if (!(mismatch.norm() <= limits.velocity_mismatch_max_mps)) {
    return FoundFault{TrajectoryFault::kMismatch, a.time_s, mismatch.norm()};
  }
  for (int i = 0; i <= kParts; ++i) {
    const double share = static_cast<double>(i) / kParts;
    const CurveSample at = interpolated(a, b, duration_s, share);
    const double time_s = a.time_s + share * duration_s;
    if (!(at.acceleration_mps2.norm() <= limits.acceleration_max_mps2)) {
      return FoundFault{TrajectoryFault::kAcceleration, time_s, at.acceleration_mps2.norm()};
    }
    if (at.velocity_mps.norm() <= kMinSpeedForCurvature_mps) continue;
    const double curvature_per_m = at.curvature_per_m();
    if (!(limits.curvature_min_per_m <= curvature_per_m &&
          curvature_per_m <= limits.curvature_max_per_m)) {
      return FoundFault{TrajectoryFault::kCurvature, time_s, curvature_per_m};
    }
  }
  return std::nullopt;
}

std::optional<FoundFault> outside(const Point& position_m, double time_s, const LabLimits& limits) {
  const auto is_within = [](double value, double min, double max) {
    return min <= value && value <= max;
  };
  if (!is_within(position_m.x(), limits.x_min_m, limits.x_max_m)) {
    return FoundFault{TrajectoryFault::kOutside, time_s, position_m.x()};
  }
  if (!is_within(position_m.y(), limits.y_min_m, limits.y_max_m)) {
    return FoundFault{TrajectoryFault::kOutside, time_s, position_m.y()};
  }
  return std::nullopt;
}

/// Of the points and of the curve between them.
std::optional<FoundFault> area_fault(std::span<const TimedPoint> points, const LabLimits& limits) {
  if (const auto found = outside(points.front().position_m, points.front().time_s, limits)) {
    return found;
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const TimedPoint& a = points[i - 1];
    const double duration_s = points[i].time_s - a.time_s;
    for (int part = 1; part <= kParts; ++part) {
      const double share = static_cast<double>(part) / kParts;
      const CurveSample at = interpolated(a, points[i], duration_s, share);
      if (const auto found = outside(at.position_m, a.time_s + share * duration_s, limits)) {
        return found;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<FoundFault> curve_fault(std::span<const TimedPoint> points, const LabLimits& limits) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (const auto found = segment_fault(points[i - 1], points[i], limits)) return found;
  }
  return std::nullopt;
}

std::optional<FoundFault> trajectory_fault(std::span<const TimedPoint> points,
                                           const std::optional<LabLimits>& limits) {
  HLC_DEMAND(!points.empty());
  const auto is_finite = [](const TimedPoint& point) {
    return std::isfinite(point.time_s) && point.position_m.allFinite() &&
           point.velocity_mps.allFinite();
  };
  for (const TimedPoint& point : points) {
    if (!is_finite(point)) return FoundFault{TrajectoryFault::kNotFinite, point.time_s, 0.0};
  }
  const auto is_not_later = [](const TimedPoint& a, const TimedPoint& b) {
    return b.time_s <= a.time_s;
  };
  if (const auto at = std::ranges::adjacent_find(points, is_not_later); at != points.end()) {
    return FoundFault{TrajectoryFault::kTimesNotIncreasing, at->time_s, 0.0};
  }
  if (points.back().velocity_mps != Eigen::Vector2d::Zero()) {
    return FoundFault{TrajectoryFault::kNotStanding, points.back().time_s,
                      points.back().velocity_mps.norm()};
  }
  if (!limits) return std::nullopt;
  if (const auto found = area_fault(points, *limits)) return found;
  return curve_fault(points, *limits);
}

std::string to_text(const FoundFault& found, const LabLimits& limits) {
  switch (found.fault) {
    case TrajectoryFault::kNotFinite:
      return "a coordinate, velocity or time is not a finite number";
    case TrajectoryFault::kTimesNotIncreasing:
      return "times of the points do not increase strictly";
    case TrajectoryFault::kNotStanding:
      return fmt::format("speed at the end = {:g} m/s, must be 0", found.value);
    case TrajectoryFault::kOutside:
      return fmt::format("coordinate = {:g} m, must be in {:g} ... {:g} in x, {:g} ... {:g} in y",
                         found.value, limits.x_min_m, limits.x_max_m, limits.y_min_m,
                         limits.y_max_m);
    case TrajectoryFault::kMismatch:
      return fmt::format(
          "velocity by positions and by velocities differ by {:g} m/s, must be <= {:g}",
          found.value, limits.velocity_mismatch_max_mps);
    case TrajectoryFault::kAcceleration:
      return fmt::format("acceleration = {:g} m/s^2, must be <= {:g}", found.value,
                         limits.acceleration_max_mps2);
    case TrajectoryFault::kCurvature:
      return fmt::format("curvature = {:g} 1/m, must be in {:g} ... {:g}", found.value,
                         limits.curvature_min_per_m, limits.curvature_max_per_m);
  }
  return "unknown";
}

}  // namespace hlc::vehicle
