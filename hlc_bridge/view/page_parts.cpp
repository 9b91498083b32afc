#include "hlc_bridge/view/page_parts.hpp"

#include <algorithm>
#include <utility>

namespace hlc::view {
namespace {

constexpr int kFormat = 1;  ///< page/model.js has the same
constexpr Nanoseconds kNanosecondsPerMillisecond = 1'000'000;

/// Names of the enumerators from 0 to `last`.
template <class Enum>
Json names_up_to(Enum last) {
  Json names = Json::array();
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    names.push_back(to_string(static_cast<Enum>(i)));
  }
  return names;
}

Json vehicle_json(const result::VehicleDescription& vehicle) {
  Json json{{"id", vehicle.id.value},
            {"name", vehicle.name},
            {"length_m", vehicle.footprint.length_m},
            {"width_m", vehicle.footprint.width_m},
            {"closed", vehicle.route && vehicle.route->is_closed()},
            {"route", Json::array()}};
  if (vehicle.route) json["route"] = line_json(vehicle.route->points_m());
  return json;
}

}  // namespace

bool takes_part(VehicleId vehicle, const result::RunFacts& facts) {
  return std::ranges::find(facts.vehicle_ids, vehicle.value) != facts.vehicle_ids.end();
}

Json run_message(const FinishedRun& run) {
  const result::RunDescription& description = run.description;
  Json json{{"kind", "run"},
            {"format", kFormat},
            {"unit_m", kUnit_m},
            {"unit_rad", kUnit_rad},
            {"scenario", description.scenario},
            {"profile", description.profile},
            {"engine", description.engine},
            {"map", description.map},
            {"subgraph", description.subgraph},
            {"policy", description.policy},
            {"rounds", description.has_two_rounds ? "two" : "sequential"},
            {"time", run.time},
            {"revision", run.revision},
            {"horizon_steps", description.horizon_steps},
            {"step_s", description.step_s},
            {"stuck_after_s", coordination::kStuckAfter_s},
            {"exit_code", run.facts.exit_code},
            {"reason", run.facts.reason},
            {"fault", run.fault},
            {"statuses", names_up_to(coordination::StepStatus::kMinimalRiskStop)},
            {"reasons", names_up_to(coordination::FallbackReason::kOffRoute)},
            {"qualities", names_up_to(coordination::PlanQuality::kUnproven)}};
  json["died"] = Json::array();
  for (const Death& death : run.facts.died) json["died"].push_back({death.process, death.sign});
  json["lanes"] = Json::array();
  if (run.map) {
    for (const auto& [id, lanelet] : run.map->lanelets) {
      json["lanes"].push_back({line_json(lanelet.left_m), line_json(lanelet.right_m)});
    }
  }
  json["vehicles"] = Json::array();
  for (const result::VehicleDescription& vehicle : description.vehicles) {
    if (takes_part(vehicle.id, run.facts)) json["vehicles"].push_back(vehicle_json(vehicle));
  }
  return json;
}

Json drive_message(int vehicle, std::span<const result::DrivenSample> samples, Nanoseconds begin,
                   Nanoseconds tick) {
  Differences x;
  Differences y;
  Differences yaw;
  Differences speed;
  for (const result::DrivenSample& sample : samples) {
    x.add(sample.pose.x_m, kUnit_m);
    y.add(sample.pose.y_m, kUnit_m);
    yaw.add(sample.pose.heading_rad, kUnit_rad);
    speed.add(sample.speed_mps, kUnit_mps);
  }
  return {{"kind", "drive"},
          {"vehicle", vehicle},
          {"begin_ms", (samples.front().t - begin) / kNanosecondsPerMillisecond},
          {"tick_ms", std::max<Nanoseconds>(1, tick / kNanosecondsPerMillisecond)},
          {"x", x.json()},
          {"y", y.json()},
          {"yaw", yaw.json()},
          {"speed", speed.json()}};
}

}  // namespace hlc::view
