#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planner/policy/speed_zones.hpp"
#include "vehicle_sim/campaign/figure_parts.hpp"
#include "vehicle_sim/campaign/figures.hpp"

namespace hlc::campaign {
namespace {

constexpr char kZoneColour[] = "#e4e4e4";
/// As shares of the largest speed: the band below the axis, and the free space above.
constexpr double kBandTop = -0.03;
constexpr double kBandBottom = -0.13;
constexpr double kRangeBottom = -0.15;
constexpr double kRangeTop = 1.05;
constexpr plot::PlotSize kFlatPanel{.width_px = 1100.0, .height_px = 210.0};

plot::PlotArea box(double from_s, double to_s, double low, double high, const std::string& colour) {
  return {.points = {{from_s, low}, {to_s, low}, {to_s, high}, {from_s, high}}, .fill = colour};
}

/// Colours by the order in which names appear.
class ColoursByName {
 public:
  std::string of(const std::string& name) {
    const auto known = std::ranges::find(names_, name);
    const std::string colour =
        plot::series_colour(static_cast<std::size_t>(known - names_.begin()));
    if (known == names_.end()) names_.push_back(name);
    return colour;
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

double largest_speed_mps(std::span<const DrivenRun> runs) {
  double largest_mps = 0.1;
  for (const DrivenRun& run : runs) {
    for (const auto& [id, drive] : run.experiment.drives) {
      for (const result::DrivenSample& sample : drive) {
        largest_mps = std::max(largest_mps, std::abs(sample.speed_mps));
      }
    }
  }
  return largest_mps;
}

/// Panel of one vehicle of a run.
class SubgraphsPanel {
 public:
  SubgraphsPanel(const DrivenRun& run, const scenario::ScenarioVehicle& vehicle, double top_mps,
                 ColoursByName& colours)
      : run_(run), vehicle_(vehicle), top_mps_(top_mps) {
    panel_.title = run_name(run) + ", " + vehicle.name;
    panel_.x_label = "time [s]";
    panel_.y_label = "speed [m/s]";
    add_zones();
    add_bands(colours);
    add_speed();
  }

  [[nodiscard]] plot::PlotPanel take() { return std::move(panel_); }

 private:
  [[nodiscard]] const result::Drive& drive() const {
    return run_.experiment.drives.at(vehicle_.id.value);
  }

  /// Shaded from its first to its last tick in a zone of one limit, which is drawn as a line.
  void add_zone(double from_s, double to_s, double limit_mps) {
    panel_.areas.push_back(box(from_s, to_s, 0.0, kRangeTop * top_mps_, kZoneColour));
    panel_.lines.push_back({.points = {{from_s, limit_mps}, {to_s, limit_mps}},
                            .colour = kMarkColour,
                            .stroke = plot::Stroke::kDashed});
  }

  void add_zones() {
    const auto [from, to] = times_of(run_.experiment.facts);
    std::optional<double> limit_mps;
    double since_s = 0.0;
    double last_s = 0.0;
    for (const result::DrivenSample& sample : drive()) {
      if (sample.t < from || sample.t > to) continue;
      const double now_s = seconds_after(sample.t, from);
      const std::optional<double> here_mps =
          policy::limit_at(run_.scenario.reconfiguration.zones, sample.pose.position_m());
      if (here_mps != limit_mps) {
        if (limit_mps) add_zone(since_s, last_s, *limit_mps);
        since_s = now_s;
        limit_mps = here_mps;
      }
      last_s = now_s;
    }
    if (limit_mps) add_zone(since_s, last_s, *limit_mps);
  }

  /// One piece for each stretch of steps on the same subgraph.
  void add_bands(ColoursByName& colours) {
    const double step_s = run_.scenario.subgraph->automaton().step_s;
    std::string name;
    double since_s = 0.0;
    double until_s = 0.0;
    const auto end_piece = [&] {
      if (until_s == since_s) return;
      panel_.areas.push_back(
          box(since_s, until_s, kBandBottom * top_mps_, kBandTop * top_mps_, colours.of(name)));
    };
    for (const result::StepRecord& row : steps_of(run_)) {
      const coordination::Report& report = row.record.report;
      if (report.vehicle != vehicle_.id) continue;
      const double now_s = step_s * static_cast<double>(row.step);
      if (report.subgraph != name) {
        end_piece();
        name = report.subgraph;
        since_s = now_s;
      }
      until_s = now_s + step_s;
    }
    end_piece();
  }

  void add_speed() {
    const auto [from, to] = times_of(run_.experiment.facts);
    plot::PlotLine line{.colour = kMarkColour};
    for (const result::DrivenSample& sample : drive()) {
      if (sample.t < from || sample.t > to) continue;
      line.points.emplace_back(seconds_after(sample.t, from), std::abs(sample.speed_mps));
    }
    panel_.lines.push_back(std::move(line));
  }

  const DrivenRun& run_;
  const scenario::ScenarioVehicle& vehicle_;
  double top_mps_;
  plot::PlotPanel panel_;
};

std::vector<plot::PlotLegend> legend_of(const ColoursByName& colours, bool has_zones) {
  std::vector<plot::PlotLegend> legend;
  for (std::size_t i = 0; i < colours.names().size(); ++i) {
    legend.push_back(
        {.text = colours.names()[i], .colour = plot::series_colour(i), .radius_px = 6.0});
  }
  legend.push_back({.text = "speed", .colour = kMarkColour, .radius_px = 0.0});
  if (!has_zones) return legend;
  legend.push_back({.text = "in a speed zone", .colour = kZoneColour, .radius_px = 6.0});
  legend.push_back({.text = "its limit",
                    .colour = kMarkColour,
                    .radius_px = 0.0,
                    .stroke = plot::Stroke::kDashed});
  return legend;
}

}  // namespace

std::string subgraphs_figure(std::span<const DrivenRun> runs) {
  const auto is_fixed = [](const DrivenRun& run) {
    return run.scenario.policy == policy::kNoPolicy;
  };
  const bool are_all_fixed = std::ranges::all_of(runs, is_fixed);
  const double top_mps = largest_speed_mps(runs);
  ColoursByName colours;
  std::vector<plot::PlotPanel> panels;
  bool has_zones = false;
  double end_s = 0.0;
  for (const DrivenRun& run : runs) {
    if (is_fixed(run) && !are_all_fixed) continue;
    const auto [from, to] = times_of(run.experiment.facts);
    end_s = std::max(end_s, seconds_after(to, from));
    has_zones = has_zones || !run.scenario.reconfiguration.zones.empty();
    for (const scenario::ScenarioVehicle& vehicle : run.scenario.vehicles) {
      panels.push_back(SubgraphsPanel(run, vehicle, top_mps, colours).take());
    }
  }
  share_range(panels, end_s, kRangeBottom * top_mps, kRangeTop * top_mps);
  return plot::svg_of(figure_title("Subgraphs that were planned on", runs), panels, 1, kFlatPanel,
                      legend_of(colours, has_zones));
}

}  // namespace hlc::campaign
