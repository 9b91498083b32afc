#include "hlc_bridge/view/page_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/waits.hpp"

namespace hlc::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;  ///< page/model.js has the same
constexpr double kUnit_m = 1e-4;
constexpr double kUnit_rad = 1e-3;
constexpr double kUnit_mps = 1e-3;
constexpr double kUnit_m2 = 1e-6;
constexpr double kUnit_s = 1e-6;  ///< of planning times
constexpr Nanoseconds kNanosecondsPerMillisecond = 1'000'000;
constexpr Nanoseconds kNanosecondsPerMicrosecond = 1'000;
constexpr Nanoseconds kLargestGap = 100'000'000;  ///< as in driven_pose_at
constexpr std::size_t kPartsOfManeuver = 10;
constexpr std::size_t kNoManeuver = static_cast<std::size_t>(-1);

std::int64_t whole(double value, double unit) {
  const bool is_sound = std::isfinite(value) && std::abs(value) < kLargestCoordinate_m;
  return is_sound ? std::llround(value / unit) : 0;
}

/// A column of differences.
class Differences {
 public:
  void add(std::int64_t value) {
    values_.push_back(value - last_);
    last_ = value;
  }
  void add(double value, double unit) { add(whole(value, unit)); }
  [[nodiscard]] Json json() const { return values_; }

 private:
  std::vector<std::int64_t> values_;
  std::int64_t last_{};
};

/// x and y in turn.
template <class Points>
Json line_json(const Points& points_m) {
  std::vector<std::int64_t> values;
  std::int64_t last_x = 0;
  std::int64_t last_y = 0;
  for (const Point& point : points_m) {
    const std::int64_t x = whole(point.x(), kUnit_m);
    const std::int64_t y = whole(point.y(), kUnit_m);
    values.push_back(x - last_x);
    values.push_back(y - last_y);
    last_x = x;
    last_y = y;
  }
  return values;
}

/// Numbers values in the order in which they appear.
template <class Value>
class Table {
 public:
  std::size_t number_of(const Value& value) {
    const auto [found, is_new] = numbers_.try_emplace(value, values_.size());
    if (is_new) values_.push_back(value);
    return found->second;
  }
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }

 private:
  std::map<Value, std::size_t> numbers_;
  std::vector<Value> values_;
};

using Ids = std::vector<int>;

Ids numbers_of(const std::vector<VehicleId>& vehicles) {
  Ids ids;
  for (const VehicleId id : vehicles) ids.push_back(id.value);
  return ids;
}

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

/// A scenario may have more vehicles than a run.
bool takes_part(VehicleId vehicle, const result::RunFacts& facts) {
  return std::ranges::find(facts.vehicle_ids, vehicle.value) != facts.vehicle_ids.end();
}

Json run_json(const FinishedRun& run) {
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

Json maneuver_json(const automaton::Maneuver& maneuver, const vehicle::VehicleParameters& vehicle) {
  std::vector<std::int64_t> path;
  for (std::size_t i = 0; i <= kPartsOfManeuver; ++i) {
    const double part = static_cast<double>(i) / kPartsOfManeuver;
    const Pose pose = automaton::state_at(maneuver, part * maneuver.duration_s, vehicle).pose;
    path.insert(path.end(), {whole(pose.x_m, kUnit_m), whole(pose.y_m, kUnit_m),
                             whole(pose.heading_rad, kUnit_rad)});
  }
  return {{"label", maneuver.label},
          {"path", std::move(path)},
          {"area", line_json(maneuver.swept_area_m.vertices_m)}};
}

/// The reports of one vehicle, column by column.
class StepColumns {
 public:
  /// @param maneuver  its number; kNoManeuver: not known
  void add(const result::StepRecord& row, std::size_t maneuver) {
    const coordination::Report& report = row.record.report;
    k_.add(static_cast<std::int64_t>(row.step));
    x_.add(report.planned_pose.x_m, kUnit_m);
    y_.add(report.planned_pose.y_m, kUnit_m);
    heading_.add(report.planned_pose.heading_rad, kUnit_rad);
    put("status", static_cast<int>(report.status));
    put("reason", static_cast<int>(report.reason));
    put("quality", static_cast<int>(report.quality));
    put("maneuver", maneuver == kNoManeuver ? Json(-1) : Json(maneuver));
    put("label", names_.number_of(report.maneuver));
    put("subgraph", names_.number_of(report.subgraph));
    put("coupled", sets_.number_of(numbers_of(report.coupled)));
    put("missing", sets_.number_of(numbers_of(report.missing)));
    put("waits_for", sets_.number_of(numbers_of(report.waiting.vehicles)));
    put("blocked_by", sets_.number_of(numbers_of(report.blocked_by)));
    put("waits_since", result::waits_since(row).value_or(0));
    put("level", report.level);
    put("generated", report.generated);
    put("expanded", report.expanded);
    put("cost_m2", whole(report.cost_m2, kUnit_m2));
    put("gap_m2", whole(report.gap_m2, kUnit_m2));
    put("deviation_m", whole(report.deviation_m, kUnit_m));
    put("planning_s", row.record.planning_ns / kNanosecondsPerMicrosecond);
    put("late_s", row.record.late_ns / kNanosecondsPerMicrosecond);
    put("is_late", row.record.deadline_missed ? 1 : 0);
  }

  [[nodiscard]] Json json(VehicleId vehicle) const {
    Json json{{"kind", "steps"},        {"vehicle", vehicle.value}, {"k", k_.json()},
              {"x", x_.json()},         {"y", y_.json()},           {"heading", heading_.json()},
              {"sets", sets_.values()}, {"names", names_.values()}};
    json["units"] = {{"cost_m2", kUnit_m2},
                     {"gap_m2", kUnit_m2},
                     {"deviation_m", kUnit_m},
                     {"planning_s", kUnit_s},
                     {"late_s", kUnit_s}};
    for (const auto& [name, column] : columns_) json["columns"][name] = column;
    return json;
  }

 private:
  void put(const char* name, Json value) { columns_[name].push_back(std::move(value)); }

  Differences k_;
  Differences x_;
  Differences y_;
  Differences heading_;
  Table<std::string> names_;
  Table<Ids> sets_;
  std::map<std::string, Json> columns_;
};

using Maneuvers = Table<const automaton::Maneuver*>;

std::vector<const result::StepRecord*> rows_of(VehicleId vehicle, const FinishedRun& run) {
  std::vector<const result::StepRecord*> rows;
  for (const result::StepRecord& row : run.rows) {
    if (row.record.report.vehicle == vehicle) rows.push_back(&row);
  }
  return rows;
}

/// @param automaton  of the plans; nullptr: not known
StepColumns columns_of(const std::vector<const result::StepRecord*>& rows,
                       const automaton::UniversalAutomaton* automaton, Maneuvers& maneuvers) {
  StepColumns columns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const result::StepRecord* next = i + 1 < rows.size() ? rows[i + 1] : nullptr;
    const automaton::Maneuver* maneuver =
        automaton != nullptr ? result::maneuver_during(*rows[i], next, *automaton) : nullptr;
    columns.add(*rows[i], maneuver != nullptr ? maneuvers.number_of(maneuver) : kNoManeuver);
  }
  return columns;
}

Json maneuvers_json(const Maneuvers& maneuvers, const automaton::UniversalAutomaton* automaton) {
  Json list = Json::array();
  if (automaton != nullptr) {
    for (const automaton::Maneuver* maneuver : maneuvers.values()) {
      list.push_back(maneuver_json(*maneuver, automaton->vehicle));
    }
  }
  return {{"kind", "maneuvers"}, {"maneuvers", std::move(list)}};
}

/// Messages `maneuvers` and, per vehicle that reported, `steps`.
void add_steps(const FinishedRun& run, Json& messages) {
  const automaton::UniversalAutomaton* automaton =
      run.description.automaton ? &run.description.automaton->automaton() : nullptr;
  Maneuvers maneuvers;
  Json steps = Json::array();
  for (const result::VehicleDescription& vehicle : run.description.vehicles) {
    const std::vector<const result::StepRecord*> rows = rows_of(vehicle.id, run);
    if (rows.empty() || !takes_part(vehicle.id, run.facts)) continue;
    steps.push_back(columns_of(rows, automaton, maneuvers).json(vehicle.id));
  }
  messages.push_back(maneuvers_json(maneuvers, automaton));
  for (Json& message : steps) messages.push_back(std::move(message));
}

/// States at equal times, without a gap.
Json stretch_json(int vehicle, std::span<const result::DrivenSample> samples, Nanoseconds begin,
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

/// Messages `drive` of what was driven from t(0) to the end of the last step.
void add_drives(const FinishedRun& run, Json& messages) {
  if (!run.facts.first_step || run.rows.empty()) return;
  const Nanoseconds begin = *run.facts.first_step * run.facts.period;
  const Nanoseconds end = begin + (run.rows.back().step + 1) * run.facts.period;
  for (const auto& [id, drive] : run.drives) {
    if (!takes_part(VehicleId{id}, run.facts)) continue;
    const auto is_before = [](const result::DrivenSample& sample, Nanoseconds t) {
      return sample.t < t;
    };
    auto first = std::lower_bound(drive.begin(), drive.end(), begin, is_before);
    const auto last = std::lower_bound(first, drive.end(), end + 1, is_before);
    while (first != last) {
      auto next = std::next(first);
      const Nanoseconds tick = next != last ? next->t - first->t : 0;
      while (tick <= kLargestGap && next != last && next->t - std::prev(next)->t == tick) ++next;
      messages.push_back(stretch_json(id, {first, next}, begin, tick));
      first = next;
    }
  }
}

Json log_json(const std::vector<result::LoggedLine>& log) {
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

}  // namespace

std::string page_messages(const FinishedRun& run) {
  Json messages = Json::array({run_json(run)});
  add_steps(run, messages);
  add_drives(run, messages);
  messages.push_back(log_json(run.log));
  return messages.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hlc::view
