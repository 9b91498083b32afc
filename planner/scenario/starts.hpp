#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/scenario/scenario.hpp"

namespace hlc::scenario {

/// The routes of the vehicles, by the vehicles' names.
[[nodiscard]] std::vector<road::DrivableRoute> routes_of(std::span<const ScenarioVehicle> vehicles);

/// The vehicle on a random route from its start lanelet on.
/// @throws std::runtime_error one line, if no way leads back to that lanelet (random_tour.hpp)
[[nodiscard]] ScenarioVehicle on_random_route(ScenarioVehicle vehicle, const road::LaneletMap& map,
                                              std::uint64_t seed);

/// What the footprint with margin of this guest overlaps at its start: a vehicle, a guest before it
/// or an obstacle, in words; empty if it stands clear.
[[nodiscard]] std::string overlapped_by_guest(std::size_t index, const Scenario& scenario);

/// Indices i < j of two vehicles whose footprints with margin overlap at the start; nothing if
/// there are none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> overlapping_starts(
    const Scenario& scenario);

/// Index of a vehicle whose footprint with margin overlaps an obstacle at the start, and of the
/// obstacle; nothing if there is none.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> start_in_obstacle(
    const Scenario& scenario);

/// The scenario with vehicle i standing at arc length starts_s_m[i] of its path, heading along it.
/// Does not check for overlaps.
/// @pre one arc length per vehicle
[[nodiscard]] Scenario with_starts(Scenario scenario, std::span<const double> starts_s_m);

/// Draws cars from scenario.candidates, none twice, with ids 1, 2, ..., at the candidates' starts,
/// and where these are too few the others from scenario.further_candidates. A candidate whose
/// footprint with margin overlaps with that of a car drawn before is drawn again, one that overlaps
/// an obstacle or a guest is left out.
/// With random routes each car gets its own (random_tour.hpp), of the same seed. The same on every
/// machine.
/// @return `cars` of them, or fewer, as many as could be placed in the best of a thousand draws
/// from each
[[nodiscard]] std::vector<ScenarioVehicle> draw_cars(const Scenario& scenario, std::size_t cars,
                                                     std::uint64_t seed);

/// The scenario with every vehicle at a random place on its path, uniform in arc length, without
/// overlaps, also of obstacles and guests; if it has candidates, with as many cars drawn from them
/// again. Guests that wander do so by another seed. The same seed gives the same starts.
/// @throws std::invalid_argument if a path is not closed, or if a thousand draws all overlap
[[nodiscard]] Scenario with_random_starts(const Scenario& scenario, std::uint64_t seed);

/// Draws these starts without relating the cars' routes to each other, which takes longest.
/// @throws std::invalid_argument as with_random_starts
void check_random_starts(const Scenario& scenario, std::uint64_t seed);

}  // namespace hlc::scenario
