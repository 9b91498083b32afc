#include "planner/coordination/priority.hpp"

#include <algorithm>

#include "planner/common/demand.hpp"

namespace hlc::coordination {

bool smaller_id_first(VehicleId a, VehicleId b) { return a < b; }

std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                    PriorityRule plans_before) {
  std::vector<VehicleId> result = graph.neighbours(vehicle);
  std::erase_if(result, [&](VehicleId other) { return !plans_before(other, vehicle); });
  return result;
}

std::uint32_t computation_level(const CouplingGraph& graph, VehicleId vehicle,
                                PriorityRule plans_before) {
  // In planning order every predecessor's level is known before it is needed.
  std::vector<VehicleId> order = graph.vehicles();
  std::ranges::sort(order, plans_before);
  std::vector<std::uint32_t> levels(order.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (graph.are_coupled(order[i], order[j])) levels[i] = std::max(levels[i], levels[j] + 1);
    }
    if (order[i] == vehicle) return levels[i];
  }
  HLC_DEMAND(false && "a vehicle of the graph", vehicle);
  return 0;
}

}  // namespace hlc::coordination
