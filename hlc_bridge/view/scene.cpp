#include "hlc_bridge/view/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/view/page_parts.hpp"

namespace hlc::view {
namespace {

constexpr double kCarHeight_m = 0.05;
constexpr double kPlan_m = 0.004;  ///< above the road, so that it hides the map's lines
constexpr int kLineStrip = 0;
constexpr int kLineLoop = 1;

struct Rgb {
  double r{};
  double g{};
  double b{};
};

constexpr Rgb kBound{0.5, 0.5, 0.5};
constexpr Rgb kObstacle{0.2, 0.2, 0.2};
/// Of the vehicles, those of Okabe and Ito as in page/page.css.
constexpr std::array<Rgb, kNumColours> kCarColours{{{0.835, 0.369, 0.0},
                                                    {0.0, 0.447, 0.698},
                                                    {0.0, 0.620, 0.451},
                                                    {0.800, 0.475, 0.655},
                                                    {0.902, 0.624, 0.0},
                                                    {0.337, 0.706, 0.914},
                                                    {0.702, 0.643, 0.0},
                                                    {0.439, 0.439, 0.439}}};

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

/// To a tenth of a millimetre: longer numbers are most of the text, and show nothing more.
double rounded_m(double value_m) { return std::round(finite(value_m) * 1e4) / 1e4; }

Json point_json(double x_m, double y_m, double z_m) {
  return {{"x", rounded_m(x_m)}, {"y", rounded_m(y_m)}, {"z", z_m}};
}

Json pose_json(const Pose& pose, double z_m) {
  const double half_rad = 0.5 * finite(pose.heading_rad);
  return {{"position", point_json(pose.x_m, pose.y_m, z_m)},
          {"orientation",
           {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(half_rad)}, {"w", std::cos(half_rad)}}}};
}

Json color_json(const Rgb& color, double alpha) {
  return {{"r", color.r}, {"g", color.g}, {"b", color.b}, {"a", alpha}};
}

template <class Points>
Json lines_json(int type, const Points& points_m, double z_m, double thickness_m,
                const Json& color) {
  Json points = Json::array();
  for (const Point& point : points_m) points.push_back(point_json(point.x(), point.y(), z_m));
  return {{"type", type},
          {"pose", pose_json({}, 0.0)},
          {"thickness", thickness_m},
          {"scale_invariant", false},
          {"points", std::move(points)},
          {"color", color},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

/// An entity of the scene: the one of the same id before it is replaced.
Json entity_json(const std::string& id, Nanoseconds time) {
  Json entity{{"timestamp", time_json(time)}, {"frame_id", "map"},     {"id", id},
              {"lifetime", time_json(0)},     {"frame_locked", false}, {"metadata", Json::array()}};
  for (const char* kind :
       {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[kind] = Json::array();
  }
  return entity;
}

}  // namespace

Json time_json(Nanoseconds time) {
  constexpr Nanoseconds kNanosecondsPerSecond = 1'000'000'000;
  return {{"sec", time / kNanosecondsPerSecond}, {"nsec", time % kNanosecondsPerSecond}};
}

std::string scene_update(Json entities) {
  return text_of({{"deletions", Json::array()}, {"entities", std::move(entities)}});
}

Scene::Scene(const FinishedRun& run) : run_(&run), colors_(colours_of(run)) {
  for (const result::VehicleDescription& vehicle : run.description.vehicles) {
    if (takes_part(vehicle.id, run.facts)) vehicles_.push_back(&vehicle);
  }
}

Json Scene::color_of(const result::VehicleDescription& vehicle, double alpha) const {
  return color_json(kCarColours.at(colors_.at(vehicle.id)), alpha);
}

Json Scene::map(Nanoseconds time) const {
  Json lanes = entity_json("lanes", time);
  if (run_->map) {
    for (const auto& [id, lanelet] : run_->map->lanelets) {
      for (const auto* bound : {&lanelet.left_m, &lanelet.right_m}) {
        lanes["lines"].push_back(
            lines_json(kLineStrip, *bound, 0.0, 0.008, color_json(kBound, 1.0)));
      }
    }
  }
  Json obstacles = entity_json("obstacles", time);
  for (const result::Obstacle& one : run_->description.obstacles) {
    obstacles["lines"].push_back(
        lines_json(kLineLoop, one.area_m.vertices_m, kPlan_m, 0.02, color_json(kObstacle, 1.0)));
  }
  Json entities = Json::array({std::move(lanes)});
  if (!obstacles["lines"].empty()) entities.push_back(std::move(obstacles));
  for (const result::VehicleDescription* vehicle : vehicles_) {
    if (!vehicle->route) continue;
    Json route = entity_json(fmt::format("route {}", vehicle->id.value), time);
    route["lines"].push_back(lines_json(vehicle->route->is_closed() ? kLineLoop : kLineStrip,
                                        vehicle->route->points_m(), 0.5 * kPlan_m, 0.004,
                                        color_of(*vehicle, 0.35)));
    entities.push_back(std::move(route));
  }
  return entities;
}

Json Scene::car(const result::VehicleDescription& vehicle, const Pose& pose,
                Nanoseconds time) const {
  const Json color = color_of(vehicle, 1.0);
  Json entity = entity_json(fmt::format("car {}", vehicle.id.value), time);
  entity["cubes"].push_back(
      {{"pose", pose_json(pose, 0.5 * kCarHeight_m)},
       {"size",
        {{"x", vehicle.footprint.length_m}, {"y", vehicle.footprint.width_m}, {"z", kCarHeight_m}}},
       {"color", color}});
  entity["texts"].push_back({{"pose", pose_json(pose, 2.0 * kCarHeight_m)},
                             {"billboard", true},
                             {"font_size", 0.1},
                             {"scale_invariant", false},
                             {"color", color_json({}, 1.0)},
                             {"text", std::to_string(vehicle.id.value)}});
  return entity;
}

Json Scene::plan(const result::VehicleDescription& vehicle, const coordination::Report& report,
                 Nanoseconds time) const {
  const Json color = color_of(vehicle, 0.8);
  Json entity = entity_json(fmt::format("plan {}", vehicle.id.value), time);
  const auto note = [&entity](const char* key, const std::string& value) {
    entity["metadata"].push_back({{"key", key}, {"value", value}});
  };
  note("status", coordination::to_string(report.status));
  std::vector<std::string> labels;
  for (const auto& [to, label] : report.plan) labels.push_back(label);
  note("maneuvers", fmt::format("{}", fmt::join(labels, ", ")));
  std::vector<Point> path_m{report.planned_pose.position_m()};
  std::vector<Json> areas;
  if (run_->description.automaton) {
    const automaton::UniversalAutomaton& automaton = run_->description.automaton->automaton();
    Pose frame = report.planned_pose;
    for (const automaton::Maneuver* maneuver : result::planned_maneuvers(report, automaton)) {
      const ConvexPolygon area_m = transformed(maneuver->swept_area_m, frame);
      areas.push_back(lines_json(kLineLoop, area_m.vertices_m, kPlan_m, 0.004, color));
      frame = compose(frame, maneuver->displacement);
      path_m.push_back(frame.position_m());
    }
  }
  entity["lines"].push_back(lines_json(kLineStrip, path_m, kPlan_m, 0.01, color));
  for (Json& area : areas) entity["lines"].push_back(std::move(area));
  return entity;
}

}  // namespace hlc::view
