#include "planner/coordination/priority.hpp"

#include <algorithm>
#include <map>

namespace hlc {

Priority constant_priority(VehicleId vehicle) { return {vehicle.value}; }

bool plans_before(VehicleId a, VehicleId b) { return constant_priority(a) < constant_priority(b); }

std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle) {
  std::vector<VehicleId> result = graph.neighbours(vehicle);
  std::erase_if(result, [&](VehicleId other) { return !plans_before(other, vehicle); });
  return result;
}

std::uint32_t computation_level(const CouplingGraph& graph, VehicleId vehicle) {
  // In the order of planning every predecessor's level is known before it is needed.
  std::vector<VehicleId> order = graph.vehicles();
  std::ranges::sort(order, plans_before);
  std::map<VehicleId, std::uint32_t> levels;
  for (const VehicleId one : order) {
    std::uint32_t level = 0;
    for (const VehicleId other : predecessors(graph, one)) {
      level = std::max(level, levels.at(other) + 1);
    }
    levels[one] = level;
  }
  return levels.at(vehicle);
}

}  // namespace hlc
