#pragma once

#include <cstdint>
#include <vector>

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// A closed tour, drawn at random: a car that follows it never has to stop, whatever the map has of
/// dead ends.
///
/// It consists of lanelets that can be reached from `start` and from which `start` can be reached.
/// From `start` it goes through 200 lanelets, each a successor of the one before, all successors
/// among those being equally likely; then it visits the lanelets not yet visited, always the
/// nearest by number of lanelets, and returns to `start`. It therefore passes through all of them,
/// most of them several times, and repeats only after that. Where there are more than 200, as in a
/// town, it returns at once: tours through all of them would be kilometres long.
///
/// The list begins with the lanelet before `start`: the place of a car that stands a little behind
/// its start is then on the tour's first lanelets, too, and not where it comes by later.
/// @param seed, vehicle  each car of a run draws its own; the same tour on every machine
/// @throws std::runtime_error one line: `start` is not in the map, or no way leads back to it
[[nodiscard]] std::vector<LaneletId> random_tour(const LaneletMap& map, LaneletId start,
                                                 std::uint64_t seed, std::uint8_t vehicle);

}  // namespace hlc::road
