#pragma once

#include <variant>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/guest.hpp"

namespace hlc::guest {

using DriverCommand = std::variant<SpeedCurvatureCommand, DirectCommand>;

/// The commands of a guest's driver, one for each tick of 20 ms, from the speed and the curvature
/// that it wants.
///
/// They stay that far below the limits that an identified µCar that follows them keeps these
/// (guest_driver_test): 0.8 of the curvature, 0.85 of the speed, 0.7 of the accelerations. To stand
/// it lets the car roll out from 0.25 m/s on, for at least as long as a command is valid: the lab's
/// speed control would drive it back.
class DriverCommands {
 public:
  DriverCommands(VehicleId vehicle, const coordination::GuestLimits& limits)
      : vehicle_(vehicle), limits_(limits) {}

  /// @param t_now  increasing
  [[nodiscard]] DriverCommand tick(Nanoseconds t_now, double speed_mps, double curvature_per_m);

 private:
  void change_speed(double wanted_mps);

  VehicleId vehicle_;
  coordination::GuestLimits limits_;
  double speed_mps_{};         ///< commanded last
  Nanoseconds rolls_until_{};  ///< until then the car obeys the command to roll out
};

}  // namespace hlc::guest
