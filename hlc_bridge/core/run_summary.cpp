#include "hlc_bridge/core/run_summary.hpp"

#include <algorithm>

#include "hlc_bridge/core/encounters.hpp"
#include "planner/road/lap.hpp"
#include "hlc_bridge/core/trace_hash.hpp"

namespace hlc {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

bool has_planned(const StepRecord& row) {
  const StepStatus status = row.record.report.status;
  return status == StepStatus::kPlanned || status == StepStatus::kFallback;
}

void add_route(const VehicleDescription& vehicle, std::span<const StepRecord* const> rows,
               double step_s, VehicleSummary& summary) {
  if (!vehicle.route) {
    return;
  }
  std::vector<Point> positions_m;
  std::vector<double> times_s;
  for (const StepRecord* row : rows) {
    positions_m.push_back(row->record.report.planned_pose.position_m());
    times_s.push_back(static_cast<double>(row->step) * step_s);
  }
  const Progress progress = progress_along(*vehicle.route, positions_m);
  summary.reference_error_m = statistics(progress.distance_m);
  summary.lap_s = lap_s(*vehicle.route, progress, times_s);
}

void add_search(std::span<const StepRecord* const> rows, VehicleSummary& summary) {
  std::vector<double> generated;
  std::vector<double> expanded;
  std::vector<double> planning_s;
  for (const StepRecord* row : rows) {
    summary.fallback_steps += row->record.report.status == StepStatus::kFallback ? 1U : 0U;
    summary.deadline_misses += row->record.deadline_missed ? 1U : 0U;
    if (has_planned(*row)) {
      generated.push_back(static_cast<double>(row->record.report.generated));
      expanded.push_back(static_cast<double>(row->record.report.expanded));
      planning_s.push_back(static_cast<double>(row->record.planning_ns) * kSecondsPerNanosecond);
    }
  }
  summary.generated = statistics(generated);
  summary.expanded = statistics(expanded);
  summary.planning_s = statistics(planning_s);
}

void add_tracking(std::span<const StepRecord* const> rows, VehicleSummary& summary) {
  std::vector<double> errors_m;
  for (const StepRecord* row : rows) {
    if (row->driven) {
      errors_m.push_back(
          (row->driven->position_m() - row->record.report.planned_pose.position_m()).norm());
    }
  }
  summary.tracking_error_m = statistics(errors_m);
}

VehicleSummary summarize_vehicle(const VehicleDescription& vehicle,
                                 std::span<const StepRecord> rows, double step_s) {
  std::vector<const StepRecord*> own;
  for (const StepRecord& row : rows) {
    if (row.record.report.vehicle == vehicle.id) {
      own.push_back(&row);
    }
  }
  VehicleSummary summary;
  summary.id = vehicle.id;
  summary.name = vehicle.name;
  summary.steps = own.size();
  add_route(vehicle, own, step_s, summary);
  add_search(own, summary);
  add_tracking(own, summary);
  return summary;
}

std::size_t largest_sum(std::span<const StepRecord> rows) {
  std::map<std::uint64_t, std::size_t> sums;
  for (const StepRecord& row : rows) {
    sums[row.step] += row.record.report.generated;
  }
  std::size_t largest = 0;
  for (const auto& [step, sum] : sums) {
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

RunSummary summarize(const RunDescription& description, const RunFacts& facts,
                     std::span<const StepRecord> rows, const Drives& drives) {
  RunSummary summary;
  summary.description = description;
  summary.steps = rows.empty() ? 0 : rows.back().step + 1;
  for (const VehicleDescription& vehicle : description.vehicles) {
    summary.vehicles.push_back(summarize_vehicle(vehicle, rows, description.step_s));
  }
  summary.generated_vertices_sum_max = largest_sum(rows);
  if (facts.first_step) {
    const Encounters close =
        encounters(description.vehicles, drives, *facts.first_step * facts.period,
                   (*facts.first_step + facts.steps) * facts.period);
    summary.min_footprint_distance_m = close.min_distance_m;
    summary.collisions = close.collisions;
  }
  summary.wall_s = facts.wall_s;
  summary.realtime_factor = facts.wall_s > 0.0 ? facts.clock_s / facts.wall_s : 0.0;
  summary.trace_sha256 = trace_sha256(rows);
  return summary;
}

}  // namespace hlc
