#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "planner/coordination/coupling.hpp"

namespace hlc::coordination {

/// What the plans of a component cost that are made in some order.
struct OrderCost {
  std::size_t without_plan{};    ///< vehicles that found no new plan
  double cost_m2{};              ///< sum over the others, each for its whole reference
  std::vector<double> costs_m2;  ///< of each vehicle in the order; infinite without a plan
  /// Vertices, and kExpansionsPerPlan for each plan; of the plans that no former order had.
  std::size_t expanded{};
};

/// True if a is better than b: fewer vehicles without a plan, then less cost.
[[nodiscard]] inline bool is_better(const OrderCost& a, const OrderCost& b) {
  return a.without_plan != b.without_plan ? a.without_plan < b.without_plan : a.cost_m2 < b.cost_m2;
}

/// Plans in this order. An order of one vehicle alone: as if it planned first, so that it costs no
/// more in any order, as far as its search ends within its budget.
/// @param to_beat  of an order of the same vehicles, or none: ends as soon as the order cannot be
/// better; then all vehicles count as without a plan, and the costs of those not planned are
/// infinite
using TryOrder =
    std::function<OrderCost(const std::vector<VehicleId>& order, const OrderCost* to_beat)>;

/// A search over orders in a control step tries no further order once its plans have expanded so
/// many vertices (OrderCost::expanded). Plans of one order may expand more, each up to its own
/// budget. How it was chosen: priorities/BUDGET.md.
inline constexpr std::size_t kMostOrderExpansions = 6'000;

/// What a plan takes beside its expansions, in expansions: to pose its problem, copy the state of
/// its controller and find the areas that it occupies.
inline constexpr std::size_t kExpansionsPerPlan = 60;

/// Searches a better order than `start` for the vehicles of one component. Deterministic, and never
/// worse than `start`.
/// @param start  a component of the graph, in the order to start from
using SearchOrder = std::vector<VehicleId> (*)(const CouplingGraph& graph,
                                               const std::vector<VehicleId>& start,
                                               const TryOrder& plan);

}  // namespace hlc::coordination
