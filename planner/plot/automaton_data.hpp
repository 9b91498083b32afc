#pragma once

#include <nlohmann/json.hpp>

#include "planner/automaton/automaton_file.hpp"

namespace hlc::plot {

/// Trims and maneuvers for the paper's Fig. 2, without self-loops:
///
///     {"labels": [name, ...], "trims": [{"speed_mps", "steering_rad"}, ...],
///      "maneuvers": [{"from", "to", "label"}, ...]}          trims by number, from 1
[[nodiscard]] nlohmann::ordered_json automaton_data(const automaton::AutomatonFile& file);

}  // namespace hlc::plot
