#include "hlc_bridge/result/explanation.hpp"

#include <array>
#include <cstddef>
#include <map>

namespace hlc::result {
namespace {

using Hindrances = std::array<bool, 4>;

Hindrances hindrances_in(const coordination::Report& report) {
  return {report.status == coordination::StepStatus::kFallback,
          report.status == coordination::StepStatus::kMinimalRiskStop,
          !report.waiting.vehicles.empty(), !report.missing.empty()};
}

}  // namespace

std::vector<Explanation> steps_to_explain(std::span<const StepRecord> rows) {
  std::vector<Explanation> steps;
  std::map<VehicleId, Hindrances> before;
  for (const StepRecord& row : rows) {
    const coordination::Report& report = row.record.report;
    if (report.status == coordination::StepStatus::kStandby) continue;
    const Hindrances now = hindrances_in(report);
    Hindrances& last = before[report.vehicle];
    bool begins = false;
    for (std::size_t i = 0; i < now.size(); ++i) begins = begins || (now[i] && !last[i]);
    if (begins) steps.push_back({.step = row.step, .vehicle = report.vehicle, .text = {}});
    last = now;
  }
  return steps;
}

}  // namespace hlc::result
