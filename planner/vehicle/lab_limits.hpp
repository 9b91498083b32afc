#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "planner/geometry/timed_curve.hpp"

namespace hlc::vehicle {

/// Limits, area and time stamps of a lab's vehicles. All bounds are on the curve that the vehicle
/// interpolates from its points (interpolated in timed_curve.hpp), at any time.
struct LabLimits {
  /// Of the path, above kMinSpeedForCurvature_mps: the steady-state limits of the vehicle's
  /// steering, to the right (< 0) and to the left (> 0), which may differ.
  double curvature_min_per_m{};
  double curvature_max_per_m{};
  /// In any direction. The lab's follower refuses more along an axis of the map.
  double acceleration_max_mps2{};
  /// Between two points: mean velocity by the positions against the mean of both velocities.
  double velocity_mismatch_max_mps{};
  /// Range of the reference point.
  double x_min_m{};
  double x_max_m{};
  double y_min_m{};
  double y_max_m{};
  /// Time between the points of a command.
  double point_interval_s{};
  /// A vehicle is at its pose this long after the pose's stamp (kMostPoseLead_s at most).
  double pose_lead_s{};
  /// Largest deviation, of position and heading together (planner/automaton/deviation.hpp), of a
  /// vehicle that follows its commands undisturbed, at stamp + lead. 0: not known.
  double tracking_error_max_m{};
};

inline constexpr double kMostPoseLead_s = 0.1;
inline constexpr double kMostTrackingError_m = 0.1;

/// Of a lab without a description 0.
[[nodiscard]] inline double pose_lead_s(const std::optional<LabLimits>& lab) {
  return lab ? lab->pose_lead_s : 0.0;
}

/// The lab's follower bounds no curvature below this speed; at standstill a path has none.
inline constexpr double kMinSpeedForCurvature_mps = 0.1;

/// A vehicle stops by itself where it is farther than this from all points that it is to follow:
/// where the objective of its follower, a sum over the points of squared distances whose weights
/// are 17 in all, exceeds 1.5 m^2 (wire contract, 6.4).
inline constexpr double kStopBound_m = 0.297;

/// Possible faults of timed points.
enum class TrajectoryFault : std::uint8_t {
  kNotFinite,           ///< a coordinate, velocity or time is not a finite number
  kTimesNotIncreasing,  ///< the times do not increase strictly
  kNotStanding,         ///< the last velocity is not 0
  kOutside,             ///< a position outside the lab's area
  kMismatch,            ///< velocities that do not fit the positions
  kAcceleration,
  kCurvature,
};

/// A fault with its time and value: x or y [m], mismatch [m/s], acceleration [m/s^2], curvature
/// [1/m].
struct FoundFault {
  TrajectoryFault fault{};
  double time_s{};
  double value{};
};

/// The first of acceleration, mismatch and curvature that exceeds the limits, if any. Mismatch and
/// acceleration are exact (the latter is linear between two points, hence largest at one of them);
/// the curvature is checked in ten parts of each interval. Invariant under rotation and translation
/// of all points.
/// @pre the points are finite and their times increase strictly
[[nodiscard]] std::optional<FoundFault> curve_fault(std::span<const TimedPoint> points,
                                                    const LabLimits& limits);

/// The fault of points that a vehicle is to follow to a standing end, if any. Without limits: the
/// first three faults only. @pre not empty
[[nodiscard]] std::optional<FoundFault> trajectory_fault(std::span<const TimedPoint> points,
                                                         const std::optional<LabLimits>& limits);

/// "curvature = 5.2 1/m, must be in -3.96 ... 4.316", without the time.
[[nodiscard]] std::string to_text(const FoundFault& found, const LabLimits& limits);

}  // namespace hlc::vehicle
