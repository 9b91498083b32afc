#include <cstddef>
#include <limits>

#include "planner/coordination/priorities/all_orders.hpp"
#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::coordination {
namespace {

constexpr std::size_t kMostVehicles = 5;  // 120 orders

std::vector<VehicleId> cheapest(const CouplingGraph& graph, const std::vector<VehicleId>& start,
                                const TryOrder& plan) {
  return cheapest_of_all_orders(graph, start, plan, std::numeric_limits<std::size_t>::max());
}

}  // namespace

/// All orders, whatever time they take: for study.
constinit const PriorityStrategy kOptimalPriorities{
    .name = "optimal",
    .meaning = "the cheapest of all orders, for up to 5 coupled vehicles",
    .assign = &smaller_ids_first,
    .search = &cheapest,
    .most_vehicles = kMostVehicles};

}  // namespace hlc::coordination
