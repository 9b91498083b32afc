#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/common/node.hpp"
#include "planner/coordination/guest.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/geometry/pose.hpp"
#include "planner/geometry/timed_curve.hpp"
#include "planner/vehicle/single_track.hpp"

namespace hlc::scenario {

/// Most entries of `guests`.
inline constexpr std::size_t kMostGuests = 10;

/// Who drives a simulated guest.
enum class GuestDrive : std::uint8_t {
  kWander,  ///< from one random place of a box to the next, at random speeds, with stops
  kTrack,   ///< along a track by its times, since its vehicle's first tick
  kByHand,  ///< who publishes VehicleCommandSpeedCurvature for it
};

/// An entry of `guests`.
struct GuestValues {
  VehicleId id;
  std::string name;
  Pose start;  ///< yaw of the vehicle, standing
  coordination::GuestLimits limits;
  std::optional<Footprint> footprint;  ///< none: that of the automaton's vehicle
  GuestDrive drive{};
  std::filesystem::path track_file;  ///< kTrack
  Box home_m;                        ///< kWander
  std::uint64_t seed{};              ///< kWander
  Node node;                         ///< its place in the file, for messages
};

/// A guest of a scenario.
struct ScenarioGuest {
  coordination::Guest guest;
  std::string name;
  Pose start;  ///< yaw of the vehicle, standing
  GuestDrive drive{};
  std::filesystem::path track_file;
  std::vector<TimedPoint> track;  ///< kTrack
  Box home_m;                     ///< kWander, as the next
  std::uint64_t seed{};
};

/// The key `guests` of a scenario; none if it is absent. Relative paths in it start at the folder
/// of `file`.
/// @throws std::invalid_argument with one line
[[nodiscard]] std::vector<GuestValues> read_guests(const Node& scenario,
                                                   const std::filesystem::path& file);

/// A track from CSV: columns t_s, x_m, y_m and any others, times increasing from 0 or more; without
/// velocities.
/// @throws std::invalid_argument, std::runtime_error with one line: file, line, column, value,
/// bound
[[nodiscard]] std::vector<TimedPoint> read_track(const std::filesystem::path& file);

/// In the same order. Reads their tracks.
/// @param vehicle  of the automaton
/// @throws as read_track
[[nodiscard]] std::vector<ScenarioGuest> guests_of(const std::vector<GuestValues>& values,
                                                   const vehicle::VehicleParameters& vehicle);

/// The guests of a scenario file, whose other keys are not read: for who drives them. Without own
/// footprints these are empty.
/// @throws as read_guests and read_track
[[nodiscard]] std::vector<ScenarioGuest> guests_of_file(const std::filesystem::path& file);

}  // namespace hlc::scenario
