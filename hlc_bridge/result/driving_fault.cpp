#include "hlc_bridge/result/driving_fault.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hlc::result {

std::string danger_of(const RunSummary& summary) {
  if (summary.collisions > 0) {
    return fmt::format("vehicles collided {} times", summary.collisions);
  }
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.steps_outside_announced_area == 0) continue;
    return fmt::format("vehicle {} left its announced areas in {} steps", vehicle.id.value,
                       vehicle.steps_outside_announced_area);
  }
  return "";
}

std::string driving_fault(const RunSummary& summary) {
  if (std::string danger = danger_of(summary); !danger.empty()) return danger;
  const RunDescription& run = summary.description;
  const double margin_m = run.automaton->automaton().vehicle.safety_margin_m;
  const double allowed_m = std::max(margin_m, run.tracking_error_max_m);
  for (const VehicleSummary& vehicle : summary.vehicles) {
    const double deviation_m = vehicle.deviation_max_m.value_or(0.0);
    if (deviation_m <= allowed_m) continue;
    return fmt::format(
        "vehicle {} deviated by up to {:.1f} mm from its plan, more than {} {:.1f} mm",
        vehicle.id.value, 1e3 * deviation_m,
        allowed_m > margin_m ? "undisturbed ones of its lab do," : "the safety margin of",
        1e3 * allowed_m);
  }
  return "";
}

}  // namespace hlc::result
