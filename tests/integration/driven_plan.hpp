#pragma once

#include <optional>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "tests/integration/recorded_commands.hpp"

/// Evaluation of a fault by the vehicles' records.
namespace hlc::test {

inline constexpr Nanoseconds kForever = ~Nanoseconds{0};

/// Largest distance of the driven positions in [from, to] from the one plan that the vehicle
/// followed at `from`: the command that its record names there, read as the lab's vehicle reads it
/// (vehicle_sim/tracking/trajectory.hpp), and its last point after its end. Any deviation from
/// then on is included, also if newer commands demand it; commands that go on with
/// the same plan do not.
/// @return nothing if the vehicle followed no command at `from`, or one that was not recorded, or
/// has no record of [from, to]
[[nodiscard]] std::optional<double> farthest_from_plan_m(const result::Drive& drive,
                                                         const Commands& commands,
                                                         std::uint8_t vehicle, Nanoseconds from,
                                                         Nanoseconds to);

/// Time since which the vehicle stands until `to`, or the end of its record: slower than counts as
/// standing (MissingVehicleRules). Nothing if it does not stand then.
[[nodiscard]] std::optional<Nanoseconds> standing_since(const result::Drive& drive, Nanoseconds to);

}  // namespace hlc::test
