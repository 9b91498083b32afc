#pragma once

#include <filesystem>

#include "planner/vehicle/lab_limits.hpp"

namespace hlc::scenario {

/// Reads the description of a lab's vehicles (launch_scripts/labs/*.yaml): all members of
/// LabLimits, the coordinates in a map `area`; pose_lead_s and tracking_error_max_m may be left out
/// (0).
/// @param step_s  of the automaton: a multiple of point_interval_s
/// @throws std::invalid_argument with one line: file, line, key, value, bound
[[nodiscard]] vehicle::LabLimits read_lab(const std::filesystem::path& file, double step_s);

}  // namespace hlc::scenario
