#include "hlc_bridge/record/step_files.hpp"

#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/record/text_file.hpp"
#include "planner/common/csv_field.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

std::string driven_fields(const std::optional<Pose>& driven) {
  return driven ? shortest_text(driven->x_m) + "," + shortest_text(driven->y_m) + "," +
                      shortest_text(driven->heading_rad)
                : ",,";
}

}  // namespace

std::string steps_csv(std::span<const StepRecord> rows) {
  std::string text =
      "step,id,status,reason,planned_x_m,planned_y_m,planned_heading_rad,planned_trim,driven_x_m,"
      "driven_y_m,driven_yaw_rad,cost_m2,generated,expanded,level,coupled,missing,deviation_m,"
      "quality,gap_m2,maneuver,subgraph\n";
  for (const StepRecord& row : rows) {
    const Report& report = row.record.report;
    text += std::to_string(row.step) + "," + std::to_string(report.vehicle.value) + "," +
            to_string(report.status) + "," + to_string(report.reason) + "," +
            shortest_text(report.planned_pose.x_m) + "," + shortest_text(report.planned_pose.y_m) +
            "," + shortest_text(report.planned_pose.heading_rad) + "," +
            std::to_string(report.planned_trim.index + 1) + "," + driven_fields(row.driven) + "," +
            shortest_text(report.cost_m2) + "," + std::to_string(report.generated) + "," +
            std::to_string(report.expanded) + "," + std::to_string(report.level) + "," +
            ids_to_text(report.coupled) + "," + ids_to_text(report.missing) + "," +
            shortest_text(report.deviation_m) + "," + to_string(report.quality) + "," +
            shortest_text(report.gap_m2) + "," + csv_field(report.maneuver) + "," +
            csv_field(report.subgraph) + "\n";
  }
  return text;
}

std::string timing_csv(std::span<const StepRecord> rows) {
  constexpr double kMillisecondsPerNanosecond = 1e-6;
  std::string text = "step,id,planning_ms,deadline_missed,late_ms\n";
  for (const StepRecord& row : rows) {
    const ReportRecord& record = row.record;
    text += std::to_string(row.step) + "," + std::to_string(record.report.vehicle.value) + "," +
            shortest_text(static_cast<double>(record.planning_ns) * kMillisecondsPerNanosecond) +
            "," + (record.deadline_missed ? "1" : "0") + "," +
            shortest_text(static_cast<double>(record.late_ns) * kMillisecondsPerNanosecond) + "\n";
  }
  return text;
}

}  // namespace hlc
