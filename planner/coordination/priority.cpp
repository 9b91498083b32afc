#include "planner/coordination/priority.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/coordination/priority_groups.hpp"

namespace hlc::coordination {

PriorityOrder::PriorityOrder(std::vector<VehicleId> order, std::vector<std::size_t> groups)
    : order_(std::move(order)), groups_(std::move(groups)) {
  HLC_DEMAND(groups_.empty() || groups_.size() == order_.size(), groups_.size(), order_.size());
}

std::size_t PriorityOrder::place(VehicleId vehicle) const {
  return static_cast<std::size_t>(std::ranges::find(order_, vehicle) - order_.begin());
}

bool PriorityOrder::operator()(VehicleId a, VehicleId b) const {
  const std::size_t place_a = place(a);
  const std::size_t place_b = place(b);
  return place_a != place_b ? place_a < place_b : a < b;
}

bool PriorityOrder::are_in_one_group(VehicleId a, VehicleId b) const {
  if (groups_.empty()) return true;
  const std::size_t place_a = place(a);
  const std::size_t place_b = place(b);
  if (place_a == order_.size() || place_b == order_.size()) return place_a == place_b;
  return groups_[place_a] == groups_[place_b];
}

std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                    const PriorityOrder& plans_before) {
  std::vector<VehicleId> result = graph.neighbours(vehicle);
  std::erase_if(result, [&](VehicleId other) {
    return !plans_before(other, vehicle) || !plans_before.are_in_one_group(other, vehicle);
  });
  return result;
}

std::map<VehicleId, std::uint32_t> computation_levels(const CouplingGraph& graph,
                                                      const PriorityOrder& plans_before) {
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

bool PriorityRule::is_beyond(std::size_t num_vehicles) const {
  return strategy->most_vehicles != 0 && num_vehicles > strategy->most_vehicles;
}

SearchOrder PriorityRule::search_for(std::size_t num_vehicles) const {
  return (is_beyond(num_vehicles) ? beyond : strategy)->search;
}

PriorityOrder PriorityRule::assign(const PrioritySituation& situation) const {
  return in_order(situation, strategy->assign(situation));
}

PriorityOrder PriorityRule::in_order(const PrioritySituation& situation,
                                     std::vector<VehicleId> order) const {
  std::vector<VehicleId> all = first;
  std::ranges::copy_if(order, std::back_inserter(all), [this](VehicleId vehicle) {
    return std::ranges::find(first, vehicle) == first.end();
  });
  if (max_levels == 0) return PriorityOrder(std::move(all));
  const std::vector<VehicleId> named = all;
  std::ranges::copy_if(
      situation.graph.vehicles(), std::back_inserter(all),
      [&named](VehicleId vehicle) { return std::ranges::find(named, vehicle) == named.end(); });
  return grouped(situation, std::move(all), max_levels);
}

}  // namespace hlc::coordination
