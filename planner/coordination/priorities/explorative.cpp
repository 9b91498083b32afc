#include <algorithm>
#include <cstddef>
#include <utility>

#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

std::vector<VehicleId> cheapest_rotation(const CouplingGraph& graph,
                                         const std::vector<VehicleId>& start,
                                         const TryOrder& plan) {
  const auto level_of = computation_levels(graph, PriorityOrder(start));
  std::size_t num_levels = 1;
  for (const VehicleId one : start) {
    num_levels = std::max<std::size_t>(num_levels, level_of.at(one) + 1);
  }
  std::vector<VehicleId> best = start;
  OrderCost least = plan(start, nullptr);
  std::size_t expanded = least.expanded;
  for (std::size_t turned = 1; turned < num_levels && expanded < kMostOrderExpansions; ++turned) {
    std::vector<VehicleId> order = start;
    std::ranges::stable_sort(order, {}, [&](VehicleId one) {
      return (level_of.at(one) + num_levels - turned) % num_levels;
    });
    const OrderCost cost = plan(order, &least);
    expanded += cost.expanded;
    if (is_better(cost, least)) {
      least = cost;
      best = std::move(order);
    }
  }
  return best;
}

}  // namespace

/// As many orders as there are computation levels: those of the constant order, rotated; and the
/// cheapest wins (P. Scheffe et al., "Simultaneous Computation with Multiple Prioritizations
/// in Multi-Agent Motion Planning"; there the orders are planned at the same time).
constinit const PriorityStrategy kExplorativePriorities{
    .name = "explorative",
    .meaning = "the cheapest of as many orders as there are levels, which are rotated",
    .assign = &smaller_ids_first,
    .search = &cheapest_rotation};

}  // namespace hlc::coordination
