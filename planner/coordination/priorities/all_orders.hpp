#pragma once

#include <cstddef>
#include <vector>

#include "planner/coordination/order_search.hpp"

namespace hlc::coordination {

/// The cheapest of all orders that are tried: `start`, then the others in lexicographic order until
/// the plans have expanded `most_expanded` vertices; of equal ones the first. Orders in which of
/// every coupled pair the same vehicle plans first lead to the same plans: one of them is tried.
[[nodiscard]] std::vector<VehicleId> cheapest_of_all_orders(const CouplingGraph& graph,
                                                            const std::vector<VehicleId>& start,
                                                            const TryOrder& plan,
                                                            std::size_t most_expanded);

}  // namespace hlc::coordination
