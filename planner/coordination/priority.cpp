#include "planner/coordination/priority.hpp"

#include <algorithm>
#include <functional>

namespace hlc::coordination {

bool PriorityRule::operator()(VehicleId a, VehicleId b) const {
  const auto place_a = std::ranges::find(first_, a);
  const auto place_b = std::ranges::find(first_, b);
  return place_a != place_b ? place_a < place_b : a < b;
}

std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                    const PriorityRule& plans_before) {
  std::vector<VehicleId> result = graph.neighbours(vehicle);
  std::erase_if(result, [&](VehicleId other) { return !plans_before(other, vehicle); });
  return result;
}

std::map<VehicleId, std::uint32_t> computation_levels(const CouplingGraph& graph,
                                                      const PriorityRule& plans_before) {
  // In planning order every predecessor's level is known before it is needed.
  std::vector<VehicleId> order = graph.vehicles();
  std::ranges::sort(order, std::cref(plans_before));
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
