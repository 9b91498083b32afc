#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "planner/scenario/scenario.hpp"

namespace hlc::scenario {

/// Indices i < j of two vehicles whose footprints with margin overlap at the start; nothing if
/// there are none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> overlapping_starts(
    const Scenario& scenario);

/// The scenario with vehicle i standing at arc length starts_s_m[i] of its path, heading along it.
/// Does not check for overlaps.
/// @pre one arc length per vehicle
[[nodiscard]] Scenario with_starts(Scenario scenario, std::span<const double> starts_s_m);

/// The scenario with every vehicle at a random place on its path, uniform in arc length, without
/// overlaps. The same seed gives the same starts.
/// @throws std::invalid_argument if a path is not closed, or if a thousand draws all overlap
[[nodiscard]] Scenario with_random_starts(const Scenario& scenario, std::uint64_t seed);

}  // namespace hlc::scenario
