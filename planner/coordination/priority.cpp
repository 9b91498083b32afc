#include "planner/coordination/priority.hpp"

#include <algorithm>

namespace hlc::coordination {

bool smaller_id_first(VehicleId a, VehicleId b) { return a < b; }

std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                    PriorityRule plans_before) {
  std::vector<VehicleId> result = graph.neighbours(vehicle);
  std::erase_if(result, [&](VehicleId other) { return !plans_before(other, vehicle); });
  return result;
}

std::map<VehicleId, std::uint32_t> computation_levels(const CouplingGraph& graph,
                                                      PriorityRule plans_before) {
  // In planning order every predecessor's level is known before it is needed.
  std::vector<VehicleId> order = graph.vehicles();
  std::ranges::sort(order, plans_before);
  std::map<VehicleId, std::uint32_t> levels;
  for (const VehicleId vehicle : order) {
    std::uint32_t level = 0;
    for (const VehicleId other : predecessors(graph, vehicle, plans_before)) {
      level = std::max(level, levels.at(other) + 1);
    }
    levels[vehicle] = level;
  }
  return levels;
}

}  // namespace hlc::coordination
