#include "planner/coordination/priorities/all_orders.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace hlc::coordination {
namespace {

/// For each coupled pair of the vehicles, sorted by ids, whether the smaller id plans first.
std::vector<bool> directions(const CouplingGraph& graph, const std::vector<VehicleId>& order) {
  std::vector<VehicleId> sorted = order;
  std::ranges::sort(sorted);
  std::vector<bool> result;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      if (!graph.are_coupled(sorted[i], sorted[j])) continue;
      result.push_back(std::ranges::find(order, sorted[i]) < std::ranges::find(order, sorted[j]));
    }
  }
  return result;
}

}  // namespace

std::vector<VehicleId> cheapest_of_all_orders(const CouplingGraph& graph,
                                              const std::vector<VehicleId>& start,
                                              const TryOrder& plan, std::size_t most_expanded) {
  std::set<std::vector<bool>> tried{directions(graph, start)};
  std::vector<VehicleId> best = start;
  OrderCost least = plan(start, nullptr);
  std::size_t expanded = least.expanded;
  std::vector<VehicleId> order = start;
  std::ranges::sort(order);
  do {
    if (expanded >= most_expanded) break;
    if (!tried.insert(directions(graph, order)).second) continue;
    OrderCost cost = plan(order, &least);
    expanded += cost.expanded;
    if (!is_better(cost, least)) continue;
    least = std::move(cost);
    best = order;
  } while (std::ranges::next_permutation(order).found);
  return best;
}

}  // namespace hlc::coordination
