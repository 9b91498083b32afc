#include "vehicle_sim/campaign/figures.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/plot/scenario_plot.hpp"
#include "planner/road/lap.hpp"
#include "vehicle_sim/campaign/figure_parts.hpp"

namespace hlc::campaign {
namespace {

using Range = Eigen::AlignedBox2d;

constexpr char kCentreColour[] = "#000000";

std::vector<Point> driven_positions(const DrivenRun& run) {
  const auto [from, to] = times_of(run.experiment.facts);
  std::vector<Point> positions_m;
  for (const result::DrivenSample& sample : run.experiment.drives.at(first_vehicle(run).id.value)) {
    if (sample.t >= from && sample.t <= to) positions_m.push_back(sample.pose.position_m());
  }
  return positions_m;
}

std::vector<Point> planned_positions(const DrivenRun& run) {
  std::vector<Point> positions_m;
  for (const result::StepRecord& row : steps_of(run)) {
    const coordination::Report& report = row.record.report;
    if (report.vehicle == first_vehicle(run).id) {
      positions_m.push_back(report.planned_pose.position_m());
    }
  }
  return positions_m;
}

/// Positions at arc lengths 0, `step_m`, ... from the start, for at most `length_m`.
std::vector<Point> at_arc_lengths(const road::ReferencePath& path,
                                  const std::vector<Point>& positions_m, double step_m,
                                  double length_m) {
  const road::Progress progress = road::progress_along(path, positions_m);
  std::vector<Point> result;
  std::size_t i = 0;
  for (double s_m = 0.0; s_m <= length_m; s_m += step_m) {
    while (i < positions_m.size() && progress.s_m[i] - progress.s_m.front() < s_m) ++i;
    if (i == positions_m.size()) break;
    result.push_back(positions_m[i]);
  }
  return result;
}

/// Place of the largest distance between the runs' paths; the start if there is one run.
Point where_they_differ(std::span<const DrivenRun> runs) {
  constexpr double kStep_m = 0.02;
  const road::ReferencePath& path = first_vehicle(runs.front()).path;
  std::vector<std::vector<Point>> ways;
  for (const DrivenRun& run : runs) {
    ways.push_back(at_arc_lengths(path, driven_positions(run), kStep_m, path.length_m()));
  }
  Point place = first_vehicle(runs.front()).start.position_m();
  double largest_m = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < std::min(ways[i].size(), ways[j].size()); ++k) {
        const double apart_m = (ways[i][k] - ways[j][k]).norm();
        if (apart_m <= largest_m) continue;
        largest_m = apart_m;
        place = 0.5 * (ways[i][k] + ways[j][k]);
      }
    }
  }
  return place;
}

PlotPoints outline(const Range& box) {
  return {box.corner(Range::BottomLeft), box.corner(Range::BottomRight),
          box.corner(Range::TopRight), box.corner(Range::TopLeft), box.corner(Range::BottomLeft)};
}

}  // namespace

std::string paths_figure(std::span<const DrivenRun> runs,
                         const std::optional<road::LaneletMap>& map) {
  constexpr double kHalfZoom_m = 0.45;
  const scenario::ScenarioVehicle& vehicle = first_vehicle(runs.front());
  plot::PlotPanel whole{.x_label = "x [m]", .y_label = "y [m]", .equal_scale = true};
  if (map) plot::add_lanes(*map, whole);
  plot::PlotLine centre = plot::path_line(vehicle.path);
  centre.colour = kCentreColour;
  centre.width_px = 1.0;
  whole.lines.push_back(std::move(centre));
  whole.legend.push_back({.text = map ? "centre of the lane" : "reference path",
                          .colour = kCentreColour,
                          .radius_px = 0.0});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::vector<Point> positions_m = driven_positions(runs[i]);
    add_series(i, run_name(runs[i]), {positions_m.begin(), positions_m.end()}, whole);
  }
  bring_dashed_to_front(whole);
  const Point middle = where_they_differ(runs);
  const Point half = Point::Constant(kHalfZoom_m);
  plot::PlotPanel zoom = whole;
  zoom.range = Range(middle - half, middle + half);
  zoom.title = "where they differ most";
  zoom.legend_corner = plot::Corner::kEmptiest;
  whole.lines.push_back({.points = outline(*zoom.range), .colour = "#444444", .width_px = 1.0});
  whole.title = "the whole drive (box: enlarged on the right)";
  whole.legend.clear();
  return plot::svg_of(figure_title("Driven paths of the vehicle " + vehicle.name, runs),
                      {whole, zoom}, 2, {.width_px = 700.0, .height_px = 640.0});
}

std::string error_figure(std::span<const DrivenRun> runs) {
  const scenario::ScenarioVehicle& vehicle = first_vehicle(runs.front());
  const std::string path =
      runs.front().scenario.map_file ? "the lane's centre" : "the reference path";
  plot::PlotPanel panel{.x_label = "arc length along " + path + ", from the start [m]",
                        .y_label = "distance to " + path + " [mm]"};
  double highest_mm = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const road::Progress progress = road::progress_along(vehicle.path, planned_positions(runs[i]));
    PlotPoints points;
    for (std::size_t k = 0; k < progress.s_m.size(); ++k) {
      const double error_mm = 1e3 * progress.distance_m[k];
      points.emplace_back(progress.s_m[k] - progress.s_m.front(), error_mm);
      highest_mm = std::max(highest_mm, error_mm);
    }
    add_series(i, run_name(runs[i]), std::move(points), panel);
  }
  bring_dashed_to_front(panel);
  if (vehicle.path.is_closed()) {
    const double lap_m = vehicle.path.length_m();
    panel.lines.push_back(
        {.points = {{lap_m, 0.0}, {lap_m, highest_mm}}, .colour = "#444444", .width_px = 1.0});
    panel.legend.push_back({.text = "one lap", .colour = "#444444", .radius_px = 0.0});
  }
  panel.legend_corner = plot::Corner::kEmptiest;
  return plot::svg_of(figure_title("Reference error of the vehicle " + vehicle.name, runs), {panel},
                      1, {.width_px = 1100.0, .height_px = 460.0});
}

}  // namespace hlc::campaign
