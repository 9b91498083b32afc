#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vehicle_sim/guest/driver_commands.hpp"

namespace hlc::guest {

/// What a human wants of a guest, by keys or the axes of a gamepad.
///
/// Keys, since a terminal does not report their release, change what is wanted and let it stay:
/// arrow up or w is faster by a tenth of the highest speed, down or s slower, left or a more to the
/// left by a quarter of the tightest curvature, right or d to the right, x straight on, space stop,
/// q the end. The first axis pushed to the left steers to the left as far as it is pushed, the
/// second pushed forwards gives the share of the highest speed.
class HandControl {
 public:
  HandControl(VehicleId vehicle, const coordination::GuestLimits& limits)
      : limits_(limits), commands_(vehicle, limits) {}

  /// Takes what a terminal sends, in pieces of any length; other characters have no effect.
  void type(std::string_view characters);
  /// @param axis   0: steering, 1: speed; others have no effect
  /// @param value  -32767 (left, forwards) ... 32767, as Linux gives it
  void push(unsigned axis, int value);
  /// Stands from now on.
  void stop();

  [[nodiscard]] bool is_over() const { return is_over_; }
  [[nodiscard]] double speed_mps() const { return speed_mps_; }              ///< wanted
  [[nodiscard]] double curvature_per_m() const { return curvature_per_m_; }  ///< the same
  [[nodiscard]] DriverCommand tick(Nanoseconds t_now) {
    return commands_.tick(t_now, speed_mps_, curvature_per_m_);
  }

 private:
  void press(char key);
  void change(double speed_mps, double curvature_per_m);

  coordination::GuestLimits limits_;
  DriverCommands commands_;
  std::string escape_;  ///< the begin of a sequence of characters for one key
  double speed_mps_{};
  double curvature_per_m_{};
  bool is_over_{};
};

}  // namespace hlc::guest
