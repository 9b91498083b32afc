#include "planner/plot/automaton_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "planner/plot/svg_plot.hpp"

namespace hlc::plot {
namespace {

constexpr double kTrimRadius_px = 9.0;
constexpr double kBeside_px = 4.0;   ///< between the arrows of two labels
constexpr double kAround_px = 16.0;  ///< by which an arrow passes a trim

std::vector<std::string> colours_of(const std::vector<std::string>& labels) {
  constexpr std::array<const char*, 5> kOthers{"#8e44ad", "#e67e22", "#16a085", "#7f8c8d",
                                               "#c2185b"};
  std::vector<std::string> colours;
  std::size_t others = 0;
  for (const std::string& label : labels) {
    if (label == "J1") {
      colours.emplace_back("#1f4fd8");
    } else if (label == "J2") {
      colours.emplace_back("#d62728");
    } else if (label == "J3") {
      colours.emplace_back("#2ca02c");
    } else {
      colours.emplace_back(kOthers.at(others++ % kOthers.size()));
    }
  }
  return colours;
}

Eigen::Vector2d place_of(const automaton::Trim& trim) {
  return {trim.steering_rad, trim.speed_mps};
}

/// True if another trim lies on the straight line between the two.
bool passes_a_trim(const automaton::Maneuver& m, const std::vector<automaton::Trim>& trims) {
  const Eigen::Vector2d from = place_of(trims[m.from.index]);
  const Eigen::Vector2d along = place_of(trims[m.to.index]) - from;
  return std::ranges::any_of(trims, [&](const automaton::Trim& trim) {
    const Eigen::Vector2d offset = place_of(trim) - from;
    const double share = offset.dot(along) / along.squaredNorm();
    return share > 1e-6 && share < 1.0 - 1e-6 && (offset - share * along).norm() < 1e-6;
  });
}

}  // namespace

std::string automaton_plot(const automaton::AutomatonFile& file) {
  const automaton::UniversalAutomaton& automaton = *file.automaton;
  const std::vector<std::string> colours = colours_of(file.labels);
  PlotPanel panel;
  panel.x_label = "steering angle [rad]";
  panel.y_label = "speed [m/s]";
  for (const automaton::Maneuver& m : automaton.maneuvers) {
    if (m.from == m.to) continue;
    const bool has_opposite = automaton.find(m.to, m.from, m.label) != nullptr;
    if (has_opposite && m.to < m.from) continue;  // drawn with the opposite one
    const auto label =
        static_cast<std::size_t>(std::ranges::find(file.labels, m.label) - file.labels.begin());
    const double middle = 0.5 * static_cast<double>(file.labels.size() - 1);
    const double around_px = passes_a_trim(m, automaton.trims) ? kAround_px : 0.0;
    panel.arrows.push_back(
        {.from = place_of(automaton.trims[m.from.index]),
         .to = place_of(automaton.trims[m.to.index]),
         .colour = colours.at(label),
         .both_ends = has_opposite,
         .gap_px = kTrimRadius_px + 3.0,
         .shift_px = around_px + kBeside_px * (static_cast<double>(label) - middle)});
  }
  for (std::size_t i = 0; i < automaton.trims.size(); ++i) {
    const Eigen::Vector2d place = place_of(automaton.trims[i]);
    panel.marks.push_back({.at = place, .mark = Mark::kRing, .radius_px = kTrimRadius_px});
    panel.texts.push_back({.at = place, .text = fmt::to_string(i + 1)});
  }
  for (std::size_t i = 0; i < file.labels.size(); ++i) {
    panel.legend.push_back(
        {.text = "optimal for " + file.labels[i], .colour = colours[i], .radius_px = 0.0});
  }
  panel.legend.push_back({.text = "trim", .mark = Mark::kRing, .radius_px = 5.0});
  panel.legend_corner = Corner::kBottomRight;
  return svg_of(
      fmt::format("Universal automaton of {}: {} trims, {} maneuvers", file.configuration_file,
                  automaton.trims.size(), automaton.maneuvers.size() - automaton.trims.size()),
      {panel}, 1, {.width_px = 900.0, .height_px = 620.0});
}

}  // namespace hlc::plot
