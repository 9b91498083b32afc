#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::result {

/// How close guests came to the vehicles of a run (footprints as driven, without margin).
struct GuestEncounters {
  std::optional<double> min_distance_m;  ///< none if they were never recorded together
  /// How often a vehicle touched a guest while the vehicle moved: what it must never do.
  std::size_t collisions{};
  /// How often a guest drove into a vehicle that stood.
  std::size_t touched{};
};

/// Checks every instant in [from, to] at which a vehicle was recorded. A vehicle stands if it is
/// not faster than MissingVehicleRules::standing_speed_mps; a touch counts as a collision if it
/// moves at any instant of it.
[[nodiscard]] GuestEncounters guest_encounters(std::span<const VehicleDescription> vehicles,
                                               std::span<const VehicleDescription> guests,
                                               const Drives& drives, Nanoseconds from,
                                               Nanoseconds to);

}  // namespace hlc::result
