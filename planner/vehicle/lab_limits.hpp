#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "planner/geometry/timed_curve.hpp"

namespace hlc {

/// What the vehicles of a lab can follow, and where. All bounds are on the curve that the vehicle
/// makes of the points it is sent (interpolated in timed_curve.hpp), at any time.
struct LabLimits {
  /// Of the path, above kMinSpeedForCurvature_mps. What the vehicle's steering gives in steady
  /// state: to the right (< 0) and to the left (> 0), which need not be alike.
  double curvature_min_per_m{};
  double curvature_max_per_m{};
  /// In any direction. The lab's follower refuses more along an axis of the map.
  double acceleration_max_mps2{};
  /// Between two points: mean velocity by the positions against the mean of both velocities.
  double velocity_mismatch_max_mps{};
  /// Where the reference point may be.
  double x_min_m{};
  double x_max_m{};
  double y_min_m{};
  double y_max_m{};
  /// Time between the points of a command.
  double point_interval_s{};
};

/// The lab's follower asks for no curvature below this speed; at standstill a path has none.
inline constexpr double kMinSpeedForCurvature_mps = 0.1;

/// What may be wrong with timed points.
enum class TrajectoryFault : std::uint8_t {
  kNotFinite,           ///< a coordinate, velocity or time is not a finite number
  kTimesNotIncreasing,  ///< the times do not increase strictly
  kNotStanding,         ///< the last velocity is not 0
  kOutside,             ///< a position outside the lab's area
  kMismatch,            ///< velocities that do not fit the positions
  kAcceleration,
  kCurvature,
};

/// A fault, when, and how much: x or y [m], mismatch [m/s], acceleration [m/s^2], curvature [1/m].
struct FoundFault {
  TrajectoryFault fault{};
  double time_s{};
  double value{};
};

/// The first of acceleration, mismatch and curvature that exceeds the limits, if any. Mismatch and
/// acceleration are exact (the latter is linear between two points, hence largest at one of them);
/// the curvature is looked at in ten parts of each interval. Turning and moving all points changes
/// nothing.
/// @pre the points are finite and their times increase strictly
[[nodiscard]] std::optional<FoundFault> curve_fault(std::span<const TimedPoint> points,
                                                    const LabLimits& limits);

/// What is wrong with points that a vehicle shall follow to a standing end, if anything. Without
/// limits: the first three faults only. @pre not empty
[[nodiscard]] std::optional<FoundFault> trajectory_fault(std::span<const TimedPoint> points,
                                                         const std::optional<LabLimits>& limits);

/// "curvature = 5.2 1/m, allowed -3.96 ... 4.316", without the time.
[[nodiscard]] std::string to_text(const FoundFault& found, const LabLimits& limits);

}  // namespace hlc
