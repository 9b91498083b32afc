#include "hlc_bridge/core/driving_fault.hpp"

namespace hlc {

std::string fault_of(const RunSummary& summary) {
  if (summary.collisions > 0) {
    return "vehicles touched each other " + std::to_string(summary.collisions) + " times";
  }
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.astray_steps == 0) continue;
    return "vehicle " + std::to_string(vehicle.id.value) +
           " was outside the areas that it had told the others in " +
           std::to_string(vehicle.astray_steps) + " steps";
  }
  return "";
}

}  // namespace hlc
