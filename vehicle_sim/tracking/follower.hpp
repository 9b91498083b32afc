#pragma once

#include <array>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/vehicle/delayed_inputs.hpp"

namespace hlc::tracking {

/// Gains of the follower. All zero: the vehicle never moves.
struct FollowerGains {
  double feed_forward{1.0};        ///< g, share of the reference's own speed
  double longitudinal_per_s{5.0};  ///< k_lon, speed per error along the reference
  double lateral_per_s{5.0};       ///< k_lat, speed towards the reference per error across it
};

/// True if position, yaw and speed are finite: what a follower needs.
[[nodiscard]] bool is_finite(const vehicle::VehicleMotion& motion);

/// All gains times `factor`.
[[nodiscard]] FollowerGains scaled(const FollowerGains& gains, double factor);

/// Result of a tick of the follower.
enum class FollowerStatus {
  kFollowing,      ///< the reference
  kNoCommand,      ///< nothing to follow: stop law
  kNotFollowable,  ///< a command that violates the lead rule, or an empty one: stop law
  kTooFar,         ///< further than `kMaxDistance_m` from the reference: stop law
  kNoEstimate,     ///< own pose or speed is not finite: throttle and steering 0
};

/// Drives a vehicle along a timed trajectory by inverting the identified model.
///
/// An input given now acts after 80 ms. The queued inputs are known, so the follower first predicts
/// its position p and speed v for t_a = t_now + 80 ms, when the new input will act for one tick T =
/// 20 ms. With the reference r and its chords c(t) = (r(t + T) - r(t)) / T (chords, not tangents,
/// because the model drives a straight line in each tick), the target is
///
///     course at t_a           angle(c(t_a)) + atan(k_lat e_lat / |c(t_a)|)
///     path speed at t_a + T   g |c(t_a + T)| + k_lon e_lon'
///
/// e = r - p at t_a and e' at t_a + T, in the frame of the chord. The model is solved for the
/// inputs:
///
/// * The steering turns the course at once, course = yaw + p3 delta + p10. The yaw needs no control
///   of its own: delta also turns it towards the target course, at the rate p4 v / p3 (15 /s at 0.8
///   m/s).
/// * The throttle changes the speed with which the *next* tick is driven.
///
/// Both are clamped to [-1, 1], and the target speed is never negative. Where the reference stands,
/// the steering is kept (a standing reference has no course) and a longitudinal error up to
/// `kStandingTolerance_m` is not corrected, so that the vehicle stands instead of creeping.
///
/// Assumption: the vehicle moves by the identified model. Then, as long as the inputs are not
/// clamped, the error along the path shrinks by the factor 1 - k_lon T per tick, across it by about
/// 1 - k_lat T.
class Follower {
 public:
  /// The lab's controller stops at this distance: its weighted sum of squares then reaches 1.5.
  static constexpr double kMaxDistance_m = 0.3;
  static constexpr double kStandingTolerance_m = 0.005;

  Follower(const FollowerGains& gains, const vehicle::IdentifiedVehicle& vehicle)
      : gains_(gains), vehicle_(vehicle) {}

  struct Output {
    vehicle::ActuatorInput input;
    FollowerStatus status{FollowerStatus::kNoCommand};
  };

  /// The input to give at `t_now`.
  /// @param estimate  present pose and speed
  /// @param command   the command to follow or nullptr
  [[nodiscard]] Output decide(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
                              const TrajectoryCommand* command) const;

  /// The input given at this tick, from any source: to be called once per tick, since the input
  /// will be queued at the next ones.
  void give(const vehicle::ActuatorInput& input) { acted_ = inputs_.give(input, vehicle_); }

  /// Both at once.
  Output tick(Nanoseconds t_now, const vehicle::VehicleMotion& estimate,
              const TrajectoryCommand* command);

  /// The input that acts from the last tick to this one; before `give` is called for this one.
  [[nodiscard]] const vehicle::ActuatorInput& acted() const { return acted_; }

 private:
  /// Reference positions at t_a, t_a + T and t_a + 2 T.
  using Reference = std::array<Point, 3>;

  [[nodiscard]] double steering_for(const Reference& reference,
                                    const vehicle::VehicleMotion& start) const;
  [[nodiscard]] double throttle_for(const Reference& reference, const vehicle::VehicleMotion& start,
                                    double steering) const;

  FollowerGains gains_;
  vehicle::IdentifiedVehicle vehicle_;
  vehicle::DelayedInputs inputs_;
  vehicle::ActuatorInput acted_;
};

}  // namespace hlc::tracking
