#include "vehicle_sim/campaign/figures.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "hlc_bridge/result/encounters.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "vehicle_sim/campaign/figure_parts.hpp"

namespace hlc::campaign {
namespace {

constexpr double kShown_m = 0.6;

/// A colour that no vehicle has.
std::string pair_colour(std::size_t pair) { return plot::series_colour(pair + 3); }

plot::PlotPanel distance_panel(const DrivenRun& run) {
  plot::PlotPanel panel{
      .title = run_name(run), .x_label = "time [s]", .y_label = "distance of footprints [m]"};
  const result::RunDescription description = result::describe(run.scenario, std::nullopt);
  const auto [from, to] = times_of(run.experiment.facts);
  std::size_t pair = 0;
  for (std::size_t i = 0; i < description.vehicles.size(); ++i) {
    for (std::size_t j = i + 1; j < description.vehicles.size(); ++j) {
      const result::VehicleDescription& a = description.vehicles[i];
      const result::VehicleDescription& b = description.vehicles[j];
      const result::Drives& drives = run.experiment.drives;
      PlotPoints points;
      bool is_shown = false;
      for (const result::TimedDistance& one : result::footprint_distances(
               a, drives.at(a.id.value), b, drives.at(b.id.value), from, to)) {
        points.emplace_back(seconds_after(one.t, from), one.distance_m);
        is_shown = is_shown || one.distance_m < kShown_m;
      }
      panel.lines.push_back({.points = std::move(points), .colour = pair_colour(pair)});
      if (is_shown) {
        panel.legend.push_back(
            {.text = a.name + " and " + b.name, .colour = pair_colour(pair), .radius_px = 0.0});
      }
      ++pair;
    }
  }
  const double end_s = seconds_after(to, from);
  const double margins_m = 2.0 * run.scenario.subgraph->automaton().vehicle.safety_margin_m;
  panel.lines.push_back({.points = {{0.0, 0.0}, {end_s, 0.0}}, .colour = "#000000"});
  panel.lines.push_back({.points = {{0.0, margins_m}, {end_s, margins_m}},
                         .colour = kMarkColour,
                         .stroke = plot::Stroke::kDashed});
  panel.legend.push_back({.text = "contact", .colour = "#000000", .radius_px = 0.0});
  panel.legend.push_back({.text = "safety margins of both",
                          .colour = kMarkColour,
                          .radius_px = 0.0,
                          .stroke = plot::Stroke::kDashed});
  return panel;
}

}  // namespace

std::string distance_figure(std::span<const DrivenRun> runs) {
  std::vector<plot::PlotPanel> panels;
  double end_s = 0.0;
  for (const DrivenRun& run : runs) {
    panels.push_back(distance_panel(run));
    const auto [from, to] = times_of(run.experiment.facts);
    end_s = std::max(end_s, seconds_after(to, from));
  }
  share_range(panels, end_s, -0.03, kShown_m);
  const std::vector<plot::PlotLegend> legend = taken_legend(panels);
  return plot::svg_of(figure_title("Distance between driven vehicles, where below 0.6 m", runs),
                      panels, columns_for(panels.size()), kSmallPanel, legend);
}

}  // namespace hlc::campaign
