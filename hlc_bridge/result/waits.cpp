#include "hlc_bridge/result/waits.hpp"

#include <algorithm>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc::result {

namespace {

/// From 0.
std::uint64_t counted_in_run(StepIndex since, const StepRecord& row) {
  return row.step - std::min(row.step, row.record.report.step.value - since.value);
}

}  // namespace

std::optional<std::uint64_t> waits_since(const StepRecord& row) {
  const coordination::Report& report = row.record.report;
  if (report.waiting.vehicles.empty()) return std::nullopt;
  return counted_in_run(report.waiting.since, row);
}

std::optional<std::uint64_t> arrived_since(const StepRecord& row) {
  const coordination::Report& report = row.record.report;
  if (!report.arrived_since) return std::nullopt;
  return counted_in_run(*report.arrived_since, row);
}

std::optional<Wait> longest_wait(std::span<const StepRecord* const> rows, double step_s) {
  std::optional<Wait> longest;
  std::optional<Wait> current;
  for (const StepRecord* row : rows) {
    const coordination::Report& report = row->record.report;
    const std::optional<std::uint64_t> since = waits_since(*row);
    if (!since) continue;
    if (!current || current->since_step != *since) current = Wait{.since_step = *since};
    current->duration_s = coordination::wait_s(report, step_s);
    for (const VehicleId vehicle : report.waiting.vehicles) {
      if (std::ranges::count(current->vehicles, vehicle) == 0) current->vehicles.push_back(vehicle);
    }
    if (current->duration_s > (longest ? longest->duration_s : 0.0)) longest = current;
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
