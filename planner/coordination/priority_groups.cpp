#include "planner/coordination/priority_groups.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace hlc::coordination {
namespace {

struct Pair {
  double distance_m;
  std::size_t a;  ///< index in the graph, as `b`
  std::size_t b;
};

std::vector<Pair> coupled_pairs(const PrioritySituation& situation) {
  const std::vector<VehicleId>& vehicles = situation.graph.vehicles();
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < vehicles.size(); ++a) {
    for (std::size_t b = a + 1; b < vehicles.size(); ++b) {
      if (!situation.graph.are_coupled(vehicles[a], vehicles[b])) continue;
      const Point from_m = situation.traffic[a]->next_pose.position_m();
      const Point to_m = situation.traffic[b]->next_pose.position_m();
      pairs.push_back({(from_m - to_m).norm(), a, b});
    }
  }
  std::ranges::sort(pairs, {},
                    [](const Pair& one) { return std::tuple(one.distance_m, one.a, one.b); });
  return pairs;
}

/// Vehicles that are not in the order, though in the graph, are not possible.
class Groups {
 public:
  Groups(const PrioritySituation& situation, std::vector<VehicleId> order)
      : situation_(&situation), order_(std::move(order)), group_of_(order_.size()) {
    std::iota(group_of_.begin(), group_of_.end(), std::size_t{});
  }

  void unite_if_at_most(std::size_t max_levels, const Pair& pair) {
    const std::vector<VehicleId>& vehicles = situation_->graph.vehicles();
    const std::size_t into = group_of_[place(vehicles[pair.a])];
    const std::size_t from = group_of_[place(vehicles[pair.b])];
    if (into == from) return;
    std::vector<std::size_t> united = group_of_;
    std::ranges::replace(united, from, into);
    if (num_levels(united, into) <= max_levels) group_of_ = std::move(united);
  }

  [[nodiscard]] PriorityOrder order() && { return PriorityOrder(std::move(order_), group_of_); }

 private:
  [[nodiscard]] std::size_t place(VehicleId vehicle) const {
    return static_cast<std::size_t>(std::ranges::find(order_, vehicle) - order_.begin());
  }

  [[nodiscard]] std::size_t num_levels(const std::vector<std::size_t>& groups,
                                       std::size_t group) const {
    std::vector<std::pair<VehicleId, std::size_t>> levels;  // of its vehicles, in their order
    std::size_t most = 0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (groups[i] != group || !is_in_graph(order_[i])) continue;
      std::size_t level = 1;
      for (const auto& [before, its_level] : levels) {
        if (situation_->graph.are_coupled(before, order_[i]))
          level = std::max(level, its_level + 1);
      }
      levels.emplace_back(order_[i], level);
      most = std::max(most, level);
    }
    return most;
  }

  [[nodiscard]] bool is_in_graph(VehicleId vehicle) const {
    return std::ranges::binary_search(situation_->graph.vehicles(), vehicle);
  }

  const PrioritySituation* situation_;
  std::vector<VehicleId> order_;
  std::vector<std::size_t> group_of_;
};

}  // namespace

PriorityOrder grouped(const PrioritySituation& situation, std::vector<VehicleId> order,
                      std::size_t max_levels) {
  Groups groups(situation, std::move(order));
  for (const Pair& pair : coupled_pairs(situation)) groups.unite_if_at_most(max_levels, pair);
  return std::move(groups).order();
}

}  // namespace hlc::coordination
