#include "hlc_bridge/view/step_messages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

using Numbers = std::vector<int>;

Numbers numbers_of(const std::vector<VehicleId>& vehicles) {
  Numbers ids;
  for (const VehicleId id : vehicles) ids.push_back(id.value);
  return ids;
}

Json maneuver_json(const automaton::Maneuver& maneuver, const vehicle::VehicleParameters& vehicle) {
  Poses path;
  for (std::size_t i = 0; i <= kPartsOfManeuver; ++i) {
    const double part = static_cast<double>(i) / kPartsOfManeuver;
    path.add(automaton::state_at(maneuver, part * maneuver.duration_s, vehicle).pose);
  }
  Json json = path.json();
  json["label"] = maneuver.label;
  json["area"] = line_json(maneuver.swept_area_m.vertices_m);
  return json;
}

std::string labels_of(const coordination::Report& report) {
  std::vector<std::string> labels;
  for (const auto& [to, label] : report.plan) labels.push_back(label);
  return fmt::format("{}", fmt::join(labels, ", "));
}

/// The reports of one vehicle, column by column.
class StepColumns {
 public:
  /// @param conflicts  of the routes of held road; nullptr: not known
  explicit StepColumns(const right_of_way::ConflictMap* conflicts) : conflicts_(conflicts) {}

  /// @param plan  numbers of its maneuvers
  void add(const result::StepRecord& row, const Numbers& plan, const std::string& together) {
    const coordination::Report& report = row.record.report;
    k_.add(static_cast<std::int64_t>(row.step));
    poses_.add(report.planned_pose);
    put("status", static_cast<int>(report.status));
    put("reason", static_cast<int>(report.reason));
    put("quality", static_cast<int>(report.quality));
    put("plan", sets_.number_of(plan));
    put("plan_labels", names_.number_of(labels_of(report)));
    put("held", sets_.number_of(held_cells(report)));
    put("label", names_.number_of(report.maneuver));
    put("subgraph", names_.number_of(report.subgraph));
    put("coupled", sets_.number_of(numbers_of(report.coupled)));
    put("missing", sets_.number_of(numbers_of(report.missing)));
    put("waits_for", sets_.number_of(numbers_of(report.waiting.vehicles)));
    put("blocked_by", sets_.number_of(numbers_of(report.blocked_by)));
    put("waits_since", result::waits_since(row).value_or(0));
    put("arrived", report.arrived_since ? 1 : 0);
    put("together", names_.number_of(together));
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
    Json json = poses_.json();
    json["kind"] = "steps";
    json["vehicle"] = vehicle.value;
    json["k"] = k_.json();
    json["sets"] = sets_.values();
    json["names"] = names_.values();
    for (const auto& [name, column] : columns_) json["columns"][name] = column;
    return json;
  }

 private:
  /// Route, first cell, and their number; empty: none.
  [[nodiscard]] Numbers held_cells(const coordination::Report& report) const {
    const bool is_known =
        conflicts_ != nullptr && report.held && report.held->route < conflicts_->num_routes();
    if (!is_known) return {};
    const auto& [route, place_m, ahead_m] = *report.held;
    const std::int64_t first = conflicts_->count_at(route, place_m);
    const std::int64_t count = conflicts_->count_at(route, place_m + ahead_m) - first + 1;
    const auto whole_route = static_cast<std::int64_t>(conflicts_->num_cells(route));
    return {static_cast<int>(route), static_cast<int>(conflicts_->index_of(route, first)),
            static_cast<int>(std::clamp<std::int64_t>(count, 0, whole_route))};
  }
  void put(const char* name, Json value) { columns_[name].push_back(std::move(value)); }

  Differences k_;
  Poses poses_;
  Table<std::string> names_;
  const right_of_way::ConflictMap* conflicts_;
  Table<Numbers> sets_;
  std::map<std::string, Json> columns_;
};

}  // namespace

Json column_tables() {
  return {{"status", "statuses"}, {"reason", "reasons"}, {"quality", "qualities"},
          {"label", "names"},     {"subgraph", "names"}, {"coupled", "sets"},
          {"missing", "sets"},    {"waits_for", "sets"}, {"blocked_by", "sets"},
          {"plan", "sets"},       {"held", "sets"},      {"plan_labels", "names"},
          {"together", "names"}};
}

Json column_units() {
  return {{"cost_m2", kUnit_m2},
          {"gap_m2", kUnit_m2},
          {"deviation_m", kUnit_m},
          {"planning_s", kUnit_s},
          {"late_s", kUnit_s}};
}

Json StepMessages::of(VehicleId vehicle, std::span<const result::StepRecord* const> rows,
                      const Together& together) {
  StepColumns columns(conflicts_.get());
  for (const result::StepRecord* row : rows) {
    Numbers plan;
    if (subgraph_) {
      for (const automaton::Maneuver* maneuver :
           result::planned_maneuvers(row->record.report, subgraph_->automaton())) {
        plan.push_back(static_cast<int>(maneuvers_.number_of(maneuver)));
      }
    }
    const auto found = together.find(row->step);
    columns.add(*row, plan, found == together.end() ? "" : found->second);
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
