#include "planner/plot/scenario_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "planner/geometry/footprint.hpp"

namespace hlc::plot {
namespace {

constexpr double kBetweenArrows_m = 1.0;
constexpr double kArrow_m = 0.02;
constexpr double kBonnetShare = 0.2;  ///< of a car's length, white: where its front is
constexpr double kThinnest_px = 1.6;
constexpr double kThicker_px = 1.8;  ///< a path drawn before another

/// Arrow heads along the path, the first at `from_m`.
void add_direction(const road::ReferencePath& path, double from_m, PlotPanel& panel) {
  for (double s_m = from_m; s_m + kArrow_m < path.length_m(); s_m += kBetweenArrows_m) {
    panel.arrows.push_back({.from = path.at(s_m), .to = path.at(s_m + kArrow_m)});
  }
}

std::string pose_text(const scenario::Scenario& scenario,
                      const scenario::ScenarioVehicle& vehicle) {
  const Pose pose = scenario::measured_start(scenario, vehicle);
  return fmt::format(", x {:.2f} m, y {:.2f} m, yaw {:.2f} rad ({:.0f} deg)", pose.x_m, pose.y_m,
                     pose.heading_rad, pose.heading_rad * 180.0 / std::numbers::pi);
}

}  // namespace

std::optional<road::LaneletMap> map_of(const scenario::Scenario& scenario) {
  if (!scenario.map_file) return std::nullopt;
  return road::read_lanelet_map(*scenario.map_file);
}

void add_lanes(const road::LaneletMap& map, PlotPanel& panel) {
  for (const auto& [id, lanelet] : map.lanelets) {
    PlotArea area{.points = {lanelet.left_m.begin(), lanelet.left_m.end()}, .fill = "#f0f0f0"};
    area.points.insert(area.points.end(), lanelet.right_m.rbegin(), lanelet.right_m.rend());
    panel.areas.push_back(std::move(area));
    for (const std::vector<Point>* bound : {&lanelet.left_m, &lanelet.right_m}) {
      panel.lines.push_back(
          {.points = {bound->begin(), bound->end()}, .colour = "#9a9a9a", .width_px = 0.8});
    }
  }
}

PlotLine path_line(const road::ReferencePath& path) {
  PlotLine line{.points = {path.points_m().begin(), path.points_m().end()}};
  if (path.is_closed()) line.points.push_back(path.points_m().front());
  return line;
}

std::string car_colour(const scenario::Scenario& scenario, std::size_t vehicle) {
  static const std::map<std::string, std::string> kNames{
      {"red", "#d62728"}, {"blue", "#1f4fd8"}, {"green", "#2ca02c"}};
  const auto named = kNames.find(scenario.vehicles[vehicle].name);
  return named != kNames.end() ? named->second : series_colour(vehicle);
}

std::string scenario_plot(const scenario::Scenario& scenario,
                          const std::optional<road::LaneletMap>& map, bool with_poses) {
  PlotPanel panel{.x_label = "x [m]", .y_label = "y [m]", .equal_scale = true};
  std::vector<PlotLegend> legend;
  if (map) add_lanes(*map, panel);
  const std::size_t count = scenario.vehicles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const scenario::ScenarioVehicle& vehicle = scenario.vehicles[i];
    PlotLine line = path_line(vehicle.path);
    line.colour = car_colour(scenario, i);
    line.width_px = kThinnest_px;
    // The first paths are the widest and lie below; a few widths suffice.
    line.width_px += kThicker_px * static_cast<double>(std::min<std::size_t>(count - 1 - i, 3));
    legend.push_back({.text = fmt::format("vehicle {}: {}", vehicle.id.value, vehicle.name) +
                              (with_poses ? pose_text(scenario, vehicle) : ""),
                      .colour = line.colour,
                      .radius_px = 0.0});
    add_direction(vehicle.path,
                  kBetweenArrows_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count),
                  panel);
    panel.lines.push_back(std::move(line));
  }
  const Footprint& footprint = scenario.subgraph->automaton().vehicle.footprint;
  for (std::size_t i = 0; i < count; ++i) {
    const scenario::ScenarioVehicle& vehicle = scenario.vehicles[i];
    const Pose start = scenario::measured_start(scenario, vehicle);
    const auto add = [&panel](const ConvexPolygon& area, const std::string& fill) {
      panel.front_areas.push_back({.points = {area.vertices_m.begin(), area.vertices_m.end()},
                                   .fill = fill,
                                   .stroke = "#000000"});
    };
    add(footprint_area(footprint, start), car_colour(scenario, i));
    const Footprint bonnet{.length_m = kBonnetShare * footprint.length_m,
                           .width_m = footprint.width_m};
    const double ahead_m = 0.5 * (footprint.length_m - bonnet.length_m);
    add(footprint_area(bonnet, compose(start, {ahead_m, 0.0, 0.0})), "#ffffff");
    panel.texts.push_back({.at = vehicle.start.position_m(),
                           .text = fmt::to_string(vehicle.id.value),
                           .colour = "#ffffff"});
  }
  return svg_of("Scenario " + scenario.name + ": reference paths, vehicles at the start", {panel},
                1, {.width_px = 900.0, .height_px = 800.0}, legend);
}

}  // namespace hlc::plot
