#pragma once

#include <termios.h>

#include <chrono>
#include <optional>
#include <string>

#include "vehicle_sim/guest/hand_control.hpp"

namespace hlc::apps {

/// Keyboard and gamepad of who drives by hand, without blocking.
class HandInputs {
 public:
  /// The keyboard is standard input; a terminal sends single keys, without showing them, until this
  /// object goes.
  /// @param gamepad  joystick device such as /dev/input/js0; empty: none
  /// @throws std::invalid_argument if it cannot be opened
  explicit HandInputs(const std::string& gamepad);
  ~HandInputs();
  HandInputs(const HandInputs&) = delete;
  HandInputs& operator=(const HandInputs&) = delete;

  /// Waits until `deadline` and passes on what comes meanwhile. False once the keyboard has ended
  /// or the gamepad has gone.
  [[nodiscard]] bool pass_to(guest::HandControl& control,
                             std::chrono::steady_clock::time_point deadline);

 private:
  [[nodiscard]] static bool pass_keys(guest::HandControl& control);
  [[nodiscard]] bool pass_axes(guest::HandControl& control) const;

  int gamepad_{-1};
  std::optional<termios> terminal_before_;
};

}  // namespace hlc::apps
