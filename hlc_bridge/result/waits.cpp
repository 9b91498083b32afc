#include "hlc_bridge/result/waits.hpp"

#include <algorithm>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc::result {

std::optional<std::uint64_t> waits_since(const StepRecord& row) {
  const coordination::Report& report = row.record.report;
  if (report.waiting.vehicles.empty()) return std::nullopt;
  return row.step - std::min(row.step, report.step.value - report.waiting.since.value);
}

std::optional<Wait> longest_wait(std::span<const StepRecord* const> rows, double step_s) {
  std::optional<Wait> longest;
  for (const StepRecord* row : rows) {
    const coordination::Report& report = row->record.report;
    const double duration_s = coordination::wait_s(report, step_s);
    if (duration_s <= (longest ? longest->duration_s : 0.0)) continue;
    longest = Wait{.duration_s = duration_s,
                   .since_step = waits_since(*row).value(),
                   .vehicles = report.waiting.vehicles};
  }
  return longest;
}

double longest_wait_s(const RunSummary& summary) {
  double longest_s = 0.0;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.wait) longest_s = std::max(longest_s, vehicle.wait->duration_s);
  }
  return longest_s;
}

std::vector<VehicleId> stuck_vehicles(const RunSummary& summary) {
  std::vector<VehicleId> ids;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.is_stuck) ids.push_back(vehicle.id);
  }
  return ids;
}

}  // namespace hlc::result
