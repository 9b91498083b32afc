#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "planner/coordination/coupling.hpp"
#include "planner/coordination/order_search.hpp"

namespace hlc::coordination {

/// In which order the vehicles of one step plan.
class PriorityOrder {
 public:
  /// Smaller ids first, one group.
  PriorityOrder() = default;
  /// @param order   each vehicle once; those that are not in it follow, smaller ids first
  /// @param groups  number of each vehicle's group, as long as `order`; absent: one group
  explicit PriorityOrder(std::vector<VehicleId> order, std::vector<std::size_t> groups = {});

  /// True if a comes before b: a strict total order.
  [[nodiscard]] bool operator()(VehicleId a, VehicleId b) const;
  /// Coupled vehicles of different groups plan at the same time: neither knows the other's new
  /// plan. The commit rule `strict` keeps them apart (commit.hpp); `agreed` does not.
  [[nodiscard]] bool are_in_one_group(VehicleId a, VehicleId b) const;
  friend bool operator==(const PriorityOrder&, const PriorityOrder&) = default;

 private:
  [[nodiscard]] std::size_t place(VehicleId vehicle) const;

  std::vector<VehicleId> order_;
  std::vector<std::size_t> groups_;
};

/// Coupled vehicles of the same group that plan before `vehicle`, sorted by id: it respects their
/// predictions.
[[nodiscard]] std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                                  const PriorityOrder& plans_before);

/// Computation level of each vehicle: 0 without predecessors, otherwise one more than the largest
/// level among them. Vehicles of one level plan at the same time.
[[nodiscard]] std::map<VehicleId, std::uint32_t> computation_levels(
    const CouplingGraph& graph, const PriorityOrder& plans_before);

/// What all controllers that received the same know alike when they assign priorities.
struct PrioritySituation {
  const CouplingGraph& graph;
  std::span<const Traffic* const> traffic;  ///< of graph.vehicles(), in that order
};

/// A way to assign priorities: one function, a pure one of the situation, and for some a second one
/// that compares orders by the plans that they lead to. See priorities/strategies.hpp.
struct PriorityStrategy {
  std::string_view name;
  std::string_view meaning;  ///< for --help
  /// @return vehicles in the order in which they plan; the rest follows, smaller ids first
  std::vector<VehicleId> (*assign)(const PrioritySituation& situation);
  /// Absent: the order above is the order. Needs controllers that plan for each other (two rounds).
  SearchOrder search{nullptr};
  /// Larger components are searched by PriorityRule::beyond. 0: no limit.
  std::size_t most_vehicles{0};
  /// Needs Traffic::reference_areas_m.
  bool compares_references{false};
};

/// PriorityStrategy::assign of all that do not compare what vehicles announce.
[[nodiscard]] std::vector<VehicleId> smaller_ids_first(const PrioritySituation& situation);

extern const PriorityStrategy kConstantPriorities;

/// How the vehicles of a run get their priorities; the same for all.
struct PriorityRule {
  const PriorityStrategy* strategy{&kConstantPriorities};
  std::vector<VehicleId> first{};  ///< plan before all others, in this order; none twice
  /// No more computation levels than these: couplings are cut where it takes the least
  /// (priority_groups.hpp). 0: no limit.
  std::size_t max_levels{0};
  /// Searches the order of components with more vehicles than the strategy can compare:
  /// kConstantPriorities (no search) or a strategy with a search and without a limit.
  const PriorityStrategy* beyond{&kConstantPriorities};

  /// The component is too large for the strategy.
  [[nodiscard]] bool is_beyond(std::size_t num_vehicles) const;
  /// The search for a component; nullptr: none.
  [[nodiscard]] SearchOrder search_for(std::size_t num_vehicles) const;
  /// The order of a step, before any search.
  [[nodiscard]] PriorityOrder assign(const PrioritySituation& situation) const;
  /// The vehicles in this order, `first` before it and with groups.
  [[nodiscard]] PriorityOrder in_order(const PrioritySituation& situation,
                                       std::vector<VehicleId> order) const;
  friend bool operator==(const PriorityRule&, const PriorityRule&) = default;
};

}  // namespace hlc::coordination
