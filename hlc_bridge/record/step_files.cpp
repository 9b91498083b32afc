#include "hlc_bridge/record/step_files.hpp"

#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/result/waits.hpp"
#include "planner/common/csv.hpp"

namespace hlc::record {
std::string steps_csv(std::span<const result::StepRecord> rows) {
  std::string text =
      "step,id,status,reason,planned_x_m,planned_y_m,planned_heading_rad,planned_trim,driven_x_m,"
      "driven_y_m,driven_yaw_rad,cost_m2,generated,expanded,level,coupled,missing,deviation_m,"
      "quality,gap_m2,maneuver,subgraph,waits_for,waits_since,blocked_by,t_s,driven_speed_mps,"
      "bound_m2,arrived_since\n";
  for (const result::StepRecord& row : rows) {
    const coordination::Report& report = row.record.report;
    const Pose& planned = report.planned_pose;
    const auto driven = [&row](double Pose::*value) {
      return row.driven ? std::optional(*row.driven.*value) : std::nullopt;
    };
    text += CsvLine(row.step, report.vehicle.value, coordination::to_string(report.status),
                    coordination::to_string(report.reason), planned.x_m, planned.y_m,
                    planned.heading_rad, report.planned_trim.index + 1, driven(&Pose::x_m),
                    driven(&Pose::y_m), driven(&Pose::heading_rad), report.cost_m2,
                    report.generated, report.expanded, report.level, ids_to_text(report.coupled),
                    ids_to_text(report.missing), report.deviation_m,
                    coordination::to_string(report.quality), report.gap_m2, report.maneuver,
                    report.subgraph, ids_to_text(report.waiting.vehicles), result::waits_since(row),
                    ids_to_text(report.blocked_by), row.t_s, row.driven_speed_mps, report.bound_m2,
                    result::arrived_since(row))
                .text();
  }
  return text;
}

std::string timing_csv(std::span<const result::StepRecord> rows) {
  constexpr double kMillisecondsPerNanosecond = 1e-6;
  std::string text = "step,id,planning_ms,deadline_missed,late_ms,response_ms\n";
  for (const result::StepRecord& row : rows) {
    const ReportRecord& record = row.record;
    text += CsvLine(row.step, record.report.vehicle.value,
                    static_cast<double>(record.planning_ns) * kMillisecondsPerNanosecond,
                    record.deadline_missed,
                    static_cast<double>(record.late_ns) * kMillisecondsPerNanosecond,
                    static_cast<double>(record.response_ns) * kMillisecondsPerNanosecond)
                .text();
  }
  return text;
}

}  // namespace hlc::record
