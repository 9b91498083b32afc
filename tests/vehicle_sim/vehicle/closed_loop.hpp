#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/vehicle/single_track.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

/// A simulated vehicle driven by commands as a controller sends them.
namespace hlc::simulated_vehicle::driven_vehicle {

inline constexpr Nanoseconds kMillisecond = 1'000'000;
inline constexpr Nanoseconds kPeriod = 200 * kMillisecond;

/// What a controller commands in step k (answer to the list of k * 200 ms + 1 ns), and where it
/// wants the vehicle to be at a time.
struct Mission {
  std::function<std::vector<TrajectoryPoint>(std::uint64_t step)> points;
  std::function<Point(Nanoseconds)> planned;
  std::uint64_t last_step{~std::uint64_t{0}};  ///< no command after this one: the controller died
};

struct Sample {
  Nanoseconds t{};
  Point planned_m;
  SimulatedVehicle::Tick tick;

  [[nodiscard]] double error_m() const {
    return (tick.driven.pose.position_m() - planned_m).norm();
  }
};

/// Ticks in [from, until). Every command goes out twice with the same create_stamp, the second
/// valid 800 ms later. The vehicle computes a tick with the answer to the last list before it.
[[nodiscard]] std::vector<Sample> drive(SimulatedVehicle& vehicle, const Mission& mission,
                                        Nanoseconds until, Nanoseconds from = 0);

struct TrackingError {
  double mean_m{};
  double max_m{};
};
/// Over the samples from `from` on.
[[nodiscard]] TrackingError tracking_error(const std::vector<Sample>& samples, Nanoseconds from);
[[nodiscard]] std::string to_string(const TrackingError& error);

/// The paper's trims by their number (Table 1); 0 is not used.
struct Trim {
  double speed_mps{};
  double steering_rad{};
};
[[nodiscard]] const Trim& trim(std::size_t number);

/// A walk through the paper's trims, one edge per step from t = 1 s on: from trim to trim speed and
/// steering ramp linearly (the J2 maneuver) in the single-track model. The vehicle stands before
/// and after.
///
/// The command of step k holds what is driven in [t(k), t(k + 2)], then a detour that will not be
/// driven: other trims to a standing end. The next command replaces it, as when a controller
/// replans.
class TrimWalk {
 public:
  static constexpr std::uint64_t kFirstStep = 5;

  /// @param trims  numbers, the first and the last are 1
  /// @param seed   for the detours
  TrimWalk(const Pose& start, std::vector<std::size_t> trims, std::uint64_t seed);

  [[nodiscard]] Mission mission() const;
  /// When the last trim is reached.
  [[nodiscard]] Nanoseconds end() const { return (kFirstStep + trims_.size() - 1) * kPeriod; }

  /// Planned state, to the 10 ms before.
  [[nodiscard]] vehicle::State state_at(Nanoseconds t) const;

 private:
  [[nodiscard]] std::vector<TrajectoryPoint> points(std::uint64_t step) const;

  std::vector<std::size_t> trims_;
  std::vector<vehicle::State> states_;  ///< every 10 ms from the first step on
  std::uint64_t seed_;
};

}  // namespace hlc::simulated_vehicle::driven_vehicle
