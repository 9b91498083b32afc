#pragma once

#include <optional>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc {

/// A position that the lab's cameras have not measured for longer is not trusted: from then on the
/// vehicle integrates its odometer and gyroscope, and nothing in its poses shows the error. The
/// cameras measure it 50 times a second, some 80 ms before the vehicle receives it, and now and
/// then one measurement is lost; so this is more than 20 measurements in a row. The vehicle itself
/// stops only after 3 s.
inline constexpr Nanoseconds kMaxPositionAge = kNanosecondsPerSecond / 2;

/// Whether the vehicle's position was measured at most kMaxPositionAge before the state was
/// created. A vehicle that has never been located reports its clock's time as the position's age.
[[nodiscard]] bool is_located(const VehicleState& state);

/// When a vehicle's states may be trusted: the one rule for the start in both kinds of time. Poses
/// of the lab's vehicles jump in their first half second, until their localization has converged.
///
/// A vehicle has settled when its states of the last kSpan, by create_stamp, were all
///   * finite (pose and speed),
///   * located (is_located), and
///   * consistent, each with the one before: created later, by at most kMostPause, and no further
///     away than kMostJump_m + kMostSpeed_mps * (time between them).
/// The first state that violates this begins a new span, as its first state if it is finite and
/// located. A state that was received before (same create_stamp) is ignored.
class SettledStates {
 public:
  static constexpr Nanoseconds kSpan = kNanosecondsPerSecond;
  static constexpr Nanoseconds kMostPause = kNanosecondsPerSecond / 2;
  static constexpr double kMostSpeed_mps = 5.0;
  static constexpr double kMostJump_m = 0.05;

  void add(const VehicleState& state);
  [[nodiscard]] bool have_settled() const;

 private:
  std::optional<VehicleState> last_;
  Nanoseconds since_{};  ///< create_stamp of the first of an unbroken row that ends with last_
};

[[nodiscard]] bool is_finite(const VehicleState& state);

}  // namespace hlc
