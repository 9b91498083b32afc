#pragma once

#include <optional>
#include <random>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/guest.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/geometry/timed_curve.hpp"
#include "planner/vehicle/identified_motion.hpp"
#include "vehicle_sim/guest/driver_commands.hpp"

namespace hlc::guest {

/// How a simulated guest is driven.
struct GuestDriverOptions {
  VehicleId vehicle;
  coordination::GuestLimits limits;
  std::vector<TimedPoint> track;  ///< to follow; empty: it wanders
  std::uint64_t seed{};           ///< of its wandering
  Box home_m;                     ///< in which it wanders
};

/// Drives a guest as a human does: looks at a point ahead and steers towards it on a circular arc
/// (pure pursuit). It knows nothing of the other vehicles, and is deterministic.
class GuestDriver {
 public:
  explicit GuestDriver(GuestDriverOptions options);

  /// Command for the tick of 20 ms at `t_now`. @param t_now  increasing
  [[nodiscard]] DriverCommand tick(Nanoseconds t_now, const vehicle::VehicleMotion& motion);

 private:
  struct Aim {
    Point towards_m{0.0, 0.0};
    double speed_mps{};
  };
  [[nodiscard]] Aim aim(double t_s, const Point& position_m);
  [[nodiscard]] Aim on_track(double t_s, const Point& position_m) const;
  [[nodiscard]] Aim wandering(double t_s, const Point& position_m);
  [[nodiscard]] double share();

  GuestDriverOptions options_;
  std::mt19937_64 random_;
  std::optional<Nanoseconds> begin_;  ///< first tick
  DriverCommands commands_;
  Aim wandering_to_{};
  double wanders_until_s_{};
};

}  // namespace hlc::guest
