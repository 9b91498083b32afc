#include "vehicle_sim/campaign/figures.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/plot/scenario_plot.hpp"
#include "vehicle_sim/campaign/distribution.hpp"
#include "vehicle_sim/campaign/figure_parts.hpp"

namespace hlc::campaign {
namespace {

using Range = Eigen::AlignedBox2d;

/// One panel of vertices_figure; `range` is extended to its smallest and largest number.
plot::PlotPanel vertices_panel(const DrivenRun& run, Range& range) {
  plot::PlotPanel panel{.title = run_name(run), .x_label = "time [s]", .y_label = "vertices"};
  panel.y_scale = plot::Scale::kLog;
  const double step_s = run.scenario.subgraph->automaton().step_s;
  const std::vector<result::StepRecord> rows = steps_of(run);
  for (std::size_t i = 0; i < run.scenario.vehicles.size(); ++i) {
    const scenario::ScenarioVehicle& vehicle = run.scenario.vehicles[i];
    const std::string colour = plot::car_colour(run.scenario, i);
    for (const auto& [field, stroke] :
         {std::pair{&coordination::Report::generated, plot::Stroke::kSolid},
          std::pair{&coordination::Report::expanded, plot::Stroke::kDashed}}) {
      plot::PlotLine line{.colour = colour, .width_px = 1.1, .stroke = stroke};
      const auto end_piece = [&] {
        if (line.points.size() > 1) panel.lines.push_back(line);
        line.points.clear();
      };
      for (const result::StepRecord& row : rows) {
        const coordination::Report& report = row.record.report;
        if (report.vehicle != vehicle.id) continue;
        const auto count = static_cast<double>(report.*field);
        if (!has_searched(report) || count < 1.0) {
          end_piece();
          continue;
        }
        line.points.emplace_back(step_s * static_cast<double>(row.step), count);
        range.extend(line.points.back());
      }
      end_piece();
    }
    panel.legend.push_back({.text = vehicle.name, .colour = colour, .radius_px = 0.0});
  }
  panel.legend.push_back({.text = "solid: generated", .colour = "#444444", .radius_px = 0.0});
  panel.legend.push_back({.text = "dashed: expanded",
                          .colour = "#444444",
                          .radius_px = 0.0,
                          .stroke = plot::Stroke::kDashed});
  return panel;
}

/// Sorted, in ms; without those not measured.
std::vector<double> planning_times_ms(const DrivenRun& run) {
  std::vector<double> times_ms;
  for (const result::StepRecord& row : steps_of(run)) {
    if (has_searched(row.record.report) && row.record.planning_ns > 0) {
      times_ms.push_back(1e-6 * static_cast<double>(row.record.planning_ns));
    }
  }
  std::ranges::sort(times_ms);
  return times_ms;
}

}  // namespace

std::string vertices_figure(std::span<const DrivenRun> runs) {
  std::vector<plot::PlotPanel> panels;
  Range range;
  for (const DrivenRun& run : runs) panels.push_back(vertices_panel(run, range));
  if (!range.isEmpty()) share_range(panels, range.max().x(), 0.8, 2.0 * range.max().y());
  const std::vector<plot::PlotLegend> legend = taken_legend(panels);
  return plot::svg_of(figure_title("Vertices of each step's search", runs), panels,
                      columns_for(panels.size()), kSmallPanel, legend);
}

std::string planning_time_figure(std::span<const DrivenRun> runs) {
  plot::PlotPanel density{.title = "distribution (ten bins a decade)",
                          .x_label = "planning time [ms]",
                          .y_label = "share of the plans [%]"};
  plot::PlotPanel tail{.title = "how many took at least so long",
                       .x_label = "planning time [ms]",
                       .y_label = "share of the plans [%]"};
  density.x_scale = plot::Scale::kLog;
  tail.x_scale = plot::Scale::kLog;
  tail.y_scale = plot::Scale::kLog;
  double highest = 1.0;
  double lowest = 100.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<double> times_ms = planning_times_ms(runs[i]);
    const PlotPoints bars = decade_histogram(times_ms);
    for (const Eigen::Vector2d& point : bars) highest = std::max(highest, point.y());
    if (!times_ms.empty()) lowest = std::min(lowest, 100.0 / static_cast<double>(times_ms.size()));
    add_series(i, run_name(runs[i]), bars, density);
    add_series(i, run_name(runs[i]), exceedance(times_ms), tail);
  }
  const double step_ms = 1e3 * runs.front().scenario.subgraph->automaton().step_s;
  for (const auto& [panel, from, to] :
       {std::tuple{&density, 0.0, highest}, std::tuple{&tail, lowest, 100.0}}) {
    panel->lines.push_back({.points = {{step_ms, from}, {step_ms, to}}, .colour = kMarkColour});
    panel->legend.push_back({.text = "length of a step", .colour = kMarkColour, .radius_px = 0.0});
    bring_dashed_to_front(*panel);
  }
  std::vector<plot::PlotPanel> panels{std::move(density), std::move(tail)};
  const std::vector<plot::PlotLegend> legend = taken_legend(panels);
  return plot::svg_of(figure_title("Planning time of all vehicles", runs), panels, 2,
                      {.width_px = 620.0, .height_px = 460.0}, legend);
}

}  // namespace hlc::campaign
