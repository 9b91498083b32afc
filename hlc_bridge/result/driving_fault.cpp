#include "hlc_bridge/result/driving_fault.hpp"

#include <cstdio>

namespace hlc::result {

std::string danger_of(const RunSummary& summary) {
  if (summary.collisions > 0) {
    return "vehicles collided " + std::to_string(summary.collisions) + " times";
  }
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.steps_outside_announced_area == 0) continue;
    return "vehicle " + std::to_string(vehicle.id.value) + " left its announced areas in " +
           std::to_string(vehicle.steps_outside_announced_area) + " steps";
  }
  return "";
}

std::string driving_fault(const RunSummary& summary) {
  if (std::string danger = danger_of(summary); !danger.empty()) return danger;
  const double margin_m = summary.description.automaton->automaton().vehicle.safety_margin_m;
  for (const VehicleSummary& vehicle : summary.vehicles) {
    const double deviation_m = vehicle.deviation_max_m.value_or(0.0);
    if (deviation_m <= margin_m) continue;
    char text[96];
    std::snprintf(
        text, sizeof text,
        "vehicle %u deviated by up to %.1f mm from its plan, more than the safety margin of "
        "%.1f mm",
        unsigned{vehicle.id.value}, 1e3 * deviation_m, 1e3 * margin_m);
    return text;
  }
  return "";
}

}  // namespace hlc::result
