#include "hlc_bridge/view/report_messages.hpp"

#include <utility>
#include <vector>

#include "hlc_bridge/view/foxglove_schemas.hpp"

namespace hlc::view {
namespace {

Json ids_json(const std::vector<VehicleId>& vehicles) {
  Json ids = Json::array();
  for (const VehicleId id : vehicles) ids.push_back(id.value);
  return ids;
}

}  // namespace

Json report_json(const ReportRecord& record, std::optional<double> speed_mps) {
  const coordination::Report& report = record.report;
  const Pose& pose = report.planned_pose;
  Json json{{"vehicle", report.vehicle.value},
            {"step", report.step.value},
            {"status", coordination::to_string(report.status)},
            {"reason", coordination::to_string(report.reason)},
            {"quality", coordination::to_string(report.quality)},
            {"planned", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}}},
            {"maneuver", report.maneuver},
            {"subgraph", report.subgraph},
            {"cost_m2", report.cost_m2},
            {"deviation_m", report.deviation_m},
            {"planning_ms", 1e-6 * static_cast<double>(record.planning_ns)},
            {"is_late", record.deadline_missed},
            {"coupled", ids_json(report.coupled)},
            {"missing", ids_json(report.missing)},
            {"waits_for", ids_json(report.waiting.vehicles)},
            {"blocked_by", ids_json(report.blocked_by)}};
  if (report.arrived_since) json["arrived_since"] = report.arrived_since->value;
  if (speed_mps) json["speed_mps"] = *speed_mps;
  return json;
}

std::string reports_message(Json reports) { return text_of({{"reports", std::move(reports)}}); }

std::string reports_schema() {
  const Json number = plain_schema("number");
  const Json text = plain_schema("string");
  const Json ids = array_schema(plain_schema("integer"));
  const Json report = object_schema(
      {{"vehicle", plain_schema("integer")},
       {"step", plain_schema("integer")},
       {"status", text},
       {"reason", text},
       {"quality", text},
       {"planned", object_schema({{"x_m", number}, {"y_m", number}, {"heading_rad", number}})},
       {"maneuver", text},
       {"subgraph", text},
       {"cost_m2", number},
       {"deviation_m", number},
       {"planning_ms", number},
       {"is_late", plain_schema("boolean")},
       {"coupled", ids},
       {"missing", ids},
       {"waits_for", ids},
       {"blocked_by", ids},
       {"arrived_since", plain_schema("integer")},
       {"speed_mps", number}});
  return schema_text(kReportsType, {{"reports", array_schema(report)}});
}

}  // namespace hlc::view
