#pragma once

#include <deque>
#include <optional>
#include <string>

#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

/// Checks the pose lead of the lab's description (LabLimits::pose_lead_s) against the drive. With
/// the measured position p, the planned position r and velocity v at stamp + lead, a vehicle that
/// follows its plan is ahead of it by the time
///
///     e = (p - r) . v / |v|^2
///
/// which vanishes if the lead is right, and otherwise is what it lacks; a vehicle that lags behind
/// its plans, or drives ahead of them, cannot be distinguished from a wrong lead. Starts and stops,
/// and plans that jump to the vehicle, spoil single values: the median of the last kMostSteps
/// counts, once there are kLeastSteps in which the vehicle was to drive with kLeastSpeed_mps or
/// more.
class PoseLeadCheck {
 public:
  static constexpr std::size_t kLeastSteps = 25;
  static constexpr std::size_t kMostSteps = 50;
  static constexpr double kLeastSpeed_mps = 0.3;
  static constexpr double kTolerance_s = 0.005;

  /// One step: the list's observation and, as its controller, that which has not observed it yet,
  /// so that the plan in force is the one that was driven.
  /// @return once: a line for the operator, when the median exceeds kTolerance_s
  [[nodiscard]] std::optional<std::string> note(const controller::Controller& controller,
                                                const controller::Observation& observation);

 private:
  std::deque<double> times_ahead_s_;
  bool is_logged_{};
};

}  // namespace hlc::high_level_controller
