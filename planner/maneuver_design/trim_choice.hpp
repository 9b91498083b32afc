#pragma once

#include <cstddef>
#include <vector>

#include "planner/automaton/automaton.hpp"

namespace hlc::maneuver_design {

/// Pose of a vehicle at a time of a drive.
struct DrivePoint {
  double time_s{};
  Pose pose;
};

/// Motion of a vehicle at a time of a drive.
struct DriveSample {
  double speed_mps{};  ///< negative in reverse
  double steering_rad{};
};

/// Slower than this counts as standing [m/s].
inline constexpr double kSlowestDrive_mps = 0.05;

[[nodiscard]] bool is_reversing(const DriveSample& sample);

/// Speed and steering of a drive given by its poses: of each window of `window_s` the circular arc
/// from its first to its last point, and the steering with which the single-track model drives that
/// arc; in reverse if the arc leads against the heading. Windows in which the vehicle turned by
/// more than a quarter turn, or on a smaller circle than the model can drive, are left out.
/// @pre times increase, window_s > 0
[[nodiscard]] std::vector<DriveSample> drive_samples(const std::vector<DrivePoint>& points,
                                                     double window_s,
                                                     const vehicle::VehicleParameters& vehicle);

/// A trim and the share of the drive that it represents, in 0 ... 1.
struct ChosenTrim {
  automaton::Trim trim;
  double share{};
};

/// `count` trims that represent a drive: standstill, and one per cluster of the samples in which
/// the vehicle moved.
///
/// The clusters are a local optimum of k-means (Lloyd's iteration): each trim is the mean of its
/// samples and each sample belongs to the nearest trim, in the plane of speed / largest speed and
/// steering / largest steering of the limits. The iteration starts from samples that are far from
/// each other (each next one the farthest from all before), so the same drive gives the same trims.
/// Samples outside the limits are moved to their border, reversing samples are left out. The trims
/// are rounded to 0.001, towards 0, and ordered as the paper's: standstill first, then by steering,
/// then by speed.
///
/// @throws std::invalid_argument if the drive has fewer than count - 1 different ways of moving, or
/// if a trim exceeds the friction circle or the curvature of the limits
/// @pre count >= 2
[[nodiscard]] std::vector<ChosenTrim> choose_trims(const std::vector<DriveSample>& drive,
                                                   std::size_t count,
                                                   const vehicle::VehicleParameters& vehicle,
                                                   const vehicle::VehicleLimits& limits);

}  // namespace hlc::maneuver_design
