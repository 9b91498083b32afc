#pragma once

#include <string>

#include "planner/automaton/automaton_file.hpp"

namespace hlc::plot {

/// The automaton as SVG, in the style of the paper's Fig. 2: trims in the plane of steering angle
/// and speed, an arrow for every edge between different trims, double where both directions exist.
/// Colours by label: blue J1, red J2, green J3, others in a fixed order. Arrows of several labels
/// between two trims are drawn side by side.
[[nodiscard]] std::string automaton_plot(const automaton::AutomatonFile& file);

}  // namespace hlc::plot
