#include "hlc_bridge/view/page_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/view/page_words.hpp"
#include "hlc_bridge/view/step_messages.hpp"
#include "planner/right_of_way/conflict_zones.hpp"

namespace hlc::view {
namespace {

constexpr int kFormat = 2;  ///< page/model.js has the same
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

/// Routes as cells of equal length: their places and the conflict zone of each (0: none).
Json roads_json(const right_of_way::ConflictMap& map) {
  const std::vector<std::uint32_t> zones = right_of_way::conflict_zones(map);
  Json roads = Json::array();
  for (std::size_t route = 0; route < map.num_routes(); ++route) {
    std::vector<Point> places_m;
    Differences zones_on;
    for (std::size_t i = 0; i < map.num_cells(route); ++i) {
      places_m.push_back(map.place_m(route, i));
      zones_on.add(zones[map.cell(route, i)]);
    }
    roads.push_back({{"places", line_json(places_m)}, {"zones", zones_on.json()}});
  }
  return roads;
}

/// What was driven, and how.
std::string about(const FinishedRun& run) {
  const result::RunDescription& description = run.description;
  std::vector<std::string> words{
      fmt::format("{} cars", run.facts.vehicle_ids.size()),
      "profile " + description.profile,
      run.time,
      description.map.empty() ? "open ground" : "map " + description.map,
      "subgraph " + description.subgraph,
      fmt::format("horizon {} steps of {} s", description.horizon_steps, description.step_s),
      description.engine};
  if (description.policy != policy::kNoPolicy) words.push_back("policy " + description.policy);
  if (description.has_two_rounds) words.emplace_back("two rounds of messages");
  words.push_back("revision " + run.revision);
  return fmt::format("{}{}", fmt::join(words, ", "), run.fork.empty() ? "" : "; " + run.fork);
}

/// What went wrong; empty: nothing.
std::string faults(const FinishedRun& run) {
  std::vector<std::string> words;
  const std::string& reason = run.facts.reason;
  if (!reason.empty() && !reason.starts_with("died: ")) words.push_back(reason);
  for (const Death& death : run.facts.died) {
    words.push_back(fmt::format("{} died ({})", death.process, death.sign));
  }
  if (!run.fault.empty()) words.push_back(run.fault);
  if (run.facts.exit_code != 0) words.push_back(fmt::format("exit code {}", run.facts.exit_code));
  return fmt::format("{}", fmt::join(words, "; "));
}

Json obstacles_json(const result::RunDescription& description) {
  Json json = Json::array();
  for (const result::Obstacle& one : description.obstacles) {
    Json points = Json::array();
    for (const Point& corner : one.area_m.vertices_m) {
      points.push_back({corner.x(), corner.y()});
    }
    json.push_back({{"points", std::move(points)},
                    {"from_s", static_cast<double>(one.from) * description.step_s}});
  }
  return json;
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

std::map<VehicleId, std::size_t> colours_of(const FinishedRun& run) {
  static const std::map<std::string, std::size_t> kNamed{{"red", 0}, {"blue", 1}, {"green", 2}};
  std::map<VehicleId, std::size_t> colours;
  for (const result::VehicleDescription& vehicle : run.description.vehicles) {
    if (!takes_part(vehicle.id, run.facts)) continue;
    const auto named = kNamed.find(vehicle.name);
    const std::size_t number = colours.size() % kNumColours;
    colours[vehicle.id] = named == kNamed.end() ? number : named->second;
  }
  return colours;
}

Json run_message(const FinishedRun& run) {
  const result::RunDescription& description = run.description;
  Json json{{"kind", "run"},
            {"format", kFormat},
            {"unit_m", kUnit_m},
            {"unit_rad", kUnit_rad},
            {"scenario", description.scenario},
            {"about", about(run)},
            {"fault", faults(run)},
            {"why", run.how_explained},
            {"words", page_words()},
            {"obstacles", obstacles_json(description)},
            {"step_s", description.step_s},
            {"stuck_after_s", coordination::kStuckAfter_s},
            {"tables", column_tables()},
            {"units", column_units()},
            {"statuses", names_up_to(coordination::StepStatus::kMinimalRiskStop)},
            {"reasons", names_up_to(coordination::FallbackReason::kOffRoute)},
            {"qualities", names_up_to(coordination::PlanQuality::kUnproven)}};
  json["lanes"] = Json::array();
  if (run.map) {
    for (const auto& [id, lanelet] : run.map->lanelets) {
      json["lanes"].push_back({line_json(lanelet.left_m), line_json(lanelet.right_m)});
    }
  }
  if (description.conflicts) json["roads"] = roads_json(*description.conflicts);
  json["vehicles"] = Json::array();
  const std::map<VehicleId, std::size_t> colours = colours_of(run);
  for (const result::VehicleDescription& vehicle : description.vehicles) {
    if (!takes_part(vehicle.id, run.facts)) continue;
    json["vehicles"].push_back(vehicle_json(vehicle));
    json["vehicles"].back()["colour"] = colours.at(vehicle.id);
    const bool is_guest =
        std::ranges::find(description.guests, vehicle.id, &result::VehicleDescription::id) !=
        description.guests.end();
    if (is_guest) json["vehicles"].back()["guest"] = true;
  }
  return json;
}

Json drive_message(int vehicle, std::span<const result::DrivenSample> samples, Nanoseconds begin,
                   Nanoseconds tick) {
  Poses poses;
  Differences speed;
  for (const result::DrivenSample& sample : samples) {
    poses.add(sample.pose);
    speed.add(sample.speed_mps, kUnit_mps);
  }
  Json json = poses.json();
  json["kind"] = "drive";
  json["vehicle"] = vehicle;
  json["begin_ms"] = (samples.front().t - begin) / kNanosecondsPerMillisecond;
  json["tick_ms"] = std::max<Nanoseconds>(1, tick / kNanosecondsPerMillisecond);
  json["speed"] = speed.json();
  return json;
}

Json log_message(const std::vector<result::LoggedLine>& log) {
  Json lines = Json::array();
  for (const result::LoggedLine& line : log) {
    lines.push_back({{"process", line.process},
                     {"stamp", line.stamp},
                     {"level", line.level},
                     {"text", line.text},
                     {"run_s", line.run_s ? Json(*line.run_s) : Json(nullptr)}});
  }
  return {{"kind", "log"}, {"lines", std::move(lines)}};
}

}  // namespace hlc::view
