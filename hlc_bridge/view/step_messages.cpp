#include "hlc_bridge/view/step_messages.hpp"

#include <string>
#include <utility>

#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/waits.hpp"

namespace hlc::view {
namespace {

constexpr double kUnit_m2 = 1e-6;
constexpr double kUnit_s = 1e-6;  ///< of planning times
constexpr Nanoseconds kNanosecondsPerMicrosecond = 1'000;
constexpr std::size_t kPartsOfManeuver = 10;
constexpr std::size_t kNoManeuver = static_cast<std::size_t>(-1);

using Ids = std::vector<int>;

Ids numbers_of(const std::vector<VehicleId>& vehicles) {
  Ids ids;
  for (const VehicleId id : vehicles) ids.push_back(id.value);
  return ids;
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

}  // namespace

Json StepMessages::of(VehicleId vehicle, std::span<const result::StepRecord* const> rows,
                      const result::StepRecord* next) {
  StepColumns columns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const result::StepRecord* after = i + 1 < rows.size() ? rows[i + 1] : next;
    const automaton::Maneuver* maneuver =
        subgraph_ ? result::maneuver_during(*rows[i], after, subgraph_->automaton()) : nullptr;
    columns.add(*rows[i], maneuver != nullptr ? maneuvers_.number_of(maneuver) : kNoManeuver);
  }
  return columns.json(vehicle);
}

Json StepMessages::new_maneuvers() {
  Json list = Json::array();
  for (; num_sent_ < maneuvers_.values().size(); ++num_sent_) {
    list.push_back(maneuver_json(*maneuvers_.values()[num_sent_], subgraph_->automaton().vehicle));
  }
  return {{"kind", "maneuvers"}, {"maneuvers", std::move(list)}};
}

}  // namespace hlc::view
