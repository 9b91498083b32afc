#include "hlc_bridge/record/summary_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hlc::record {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillisecondsPerSecond = 1e3;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// JSON has no infinity.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json joint_gap_json(const std::optional<coordination::JointGapFigures>& figures) {
  if (!figures) return nullptr;
  return {{"known", figures->known},
          {"unknown", figures->unknown},
          {"closed", figures->closed},
          {"median", finite_or_null(figures->median)},
          {"p99", finite_or_null(figures->p99)},
          {"total", finite_or_null(figures->total)}};
}

/// The named figures of a sample, all null if it is empty.
Json figures(const std::optional<result::Statistics>& value, double factor,
             std::initializer_list<std::pair<const char*, double result::Statistics::*>> names) {
  Json json;
  for (const auto& [name, field] : names) {
    json[name] = value ? Json((*value).*field * factor) : Json(nullptr);
  }
  return json;
}

Json numbers(const std::vector<VehicleId>& ids) {
  Json json = Json::array();
  for (const VehicleId id : ids) json.push_back(id.value);
  return json;
}

Json vehicle_json(const result::VehicleSummary& vehicle) {
  Json json;
  json["id"] = vehicle.id.value;
  json["name"] = vehicle.name;
  json["lap_s"] = or_null(vehicle.lap_s);
  json["reference_error_mm"] = figures(vehicle.reference_error_m, result::kMillimetresPerMetre,
                                       {{"mean", &result::Statistics::mean},
                                        {"std", &result::Statistics::std},
                                        {"max", &result::Statistics::max}});
  json["tracking_error_mm"] =
      figures(vehicle.tracking_error_m, result::kMillimetresPerMetre,
              {{"mean", &result::Statistics::mean}, {"max", &result::Statistics::max}});
  json["generated_vertices"] =
      figures(vehicle.generated, 1.0,
              {{"max", &result::Statistics::max}, {"mean", &result::Statistics::mean}});
  json["expanded_vertices"] =
      figures(vehicle.expanded, 1.0,
              {{"max", &result::Statistics::max}, {"mean", &result::Statistics::mean}});
  json["planning_time_ms"] = figures(vehicle.planning_s, kMillisecondsPerSecond,
                                     {{"mean", &result::Statistics::mean},
                                      {"std", &result::Statistics::std},
                                      {"p99", &result::Statistics::p99},
                                      {"max", &result::Statistics::max}});
  json["fallback_steps"] = vehicle.fallback_steps;
  json["deadline_misses"] = vehicle.deadline_misses;
  json["budget_share"] = or_null(vehicle.budget_share);
  json["plans_exceeding_step"] = vehicle.plans_exceeding_step;
  json["undrivable_steps"] = vehicle.undrivable_steps;
  json["driven_error_mm"] = figures(vehicle.driven_error_m, result::kMillimetresPerMetre,
                                    {{"mean", &result::Statistics::mean},
                                     {"std", &result::Statistics::std},
                                     {"max", &result::Statistics::max}});
  json["longest_wait"] = vehicle.wait ? Json{{"duration_s", vehicle.wait->duration_s},
                                             {"since_step", vehicle.wait->since_step},
                                             {"waits_for", numbers(vehicle.wait->vehicles)}}
                                      : Json(nullptr);
  json["arrived_s"] = or_null(vehicle.arrived_s);
  json["driven_speed_mps"] =
      figures(vehicle.driven_speed_mps, 1.0,
              {{"mean", &result::Statistics::mean}, {"max", &result::Statistics::max}});
  json["plan_cost_m2"] =
      figures(vehicle.plan_cost_m2, 1.0,
              {{"mean", &result::Statistics::mean}, {"max", &result::Statistics::max}});
  return json;
}

Json obstacles_json(const std::vector<result::Obstacle>& obstacles) {
  Json json = Json::array();
  for (const result::Obstacle& one : obstacles) {
    Json corners_m = Json::array();
    for (const Point& corner : one.area_m.vertices_m) corners_m.push_back({corner.x(), corner.y()});
    json.push_back({{"name", one.name.empty() ? Json(nullptr) : Json(one.name)},
                    {"from_step", one.from},
                    {"corners_m", std::move(corners_m)}});
  }
  return json;
}

}  // namespace

std::string summary_json(const result::RunSummary& summary) {
  const result::RunDescription& run = summary.description;
  Json json;
  json["scenario"] = run.scenario;
  json["profile"] = run.profile;
  json["map"] = run.map.empty() ? Json(nullptr) : Json(run.map);
  json["seed"] = run.noise_seed ? Json(*run.noise_seed) : Json(nullptr);
  json["subgraph"] = run.subgraph;
  json["horizon_steps"] = run.horizon_steps;
  json["step_s"] = run.step_s;
  json["steps"] = summary.steps;
  json["vehicles"] = Json::array();
  for (const result::VehicleSummary& vehicle : summary.vehicles) {
    json["vehicles"].push_back(vehicle_json(vehicle));
  }
  json["generated_vertices_sum_max"] = summary.generated_vertices_sum_max;
  json["min_footprint_distance_m"] = or_null(summary.min_footprint_distance_m);
  json["collisions"] = summary.collisions;
  json["wall_s"] = summary.wall_s;
  json["realtime_factor"] = summary.realtime_factor;
  json["response_time_ms"] = figures(summary.response_s, kMillisecondsPerSecond,
                                     {{"mean", &result::Statistics::mean},
                                      {"p99", &result::Statistics::p99},
                                      {"max", &result::Statistics::max}});
  json["trace_sha256"] = summary.trace_sha256;
  json["revision"] = summary.revision;
  json["host"] = {
      {"cpu", summary.host.cpu}, {"cores", summary.host.cores}, {"kernel", summary.host.kernel}};
  json["engine"] = run.engine;
  json["expanded_vertices_sum_max"] = summary.expanded_vertices_sum_max;
  json["policy"] = run.policy;
  json["longest_wait_s"] = result::longest_wait_s(summary);
  json["stuck_vehicles"] = numbers(result::stuck_vehicles(summary));
  json["joint_gap"] = joint_gap_json(summary.joint_gap);
  json["priorities"] = run.priorities;
  json["rounds"] = run.has_two_rounds ? "two" : "sequential";
  json["min_obstacle_distance_m"] = or_null(summary.min_obstacle_distance_m);
  json["obstacles"] = obstacles_json(run.obstacles);
  json["guests"] = Json::array();
  for (const result::VehicleDescription& one : run.guests) {
    json["guests"].push_back({{"id", one.id.value}, {"name", one.name}});
  }
  json["min_guest_distance_m"] = or_null(summary.with_guests.min_distance_m);
  json["touched_by_guests"] = summary.with_guests.touched;
  return json.dump(2) + "\n";
}

}  // namespace hlc::record
