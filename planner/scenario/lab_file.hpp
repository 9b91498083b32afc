#pragma once

#include <filesystem>

#include "planner/vehicle/lab_limits.hpp"

namespace hlc {

/// Reads what the vehicles of a lab can follow, and where (launch_scripts/labs/*.yaml): all members
/// of LabLimits, the coordinates in a map `area`.
/// @param step_s  of the automaton that is driven: a multiple of point_interval_s
/// @throws std::invalid_argument with one line: file, line, key, value, what is allowed
[[nodiscard]] LabLimits read_lab(const std::filesystem::path& file, double step_s);

}  // namespace hlc
