#pragma once

#include <cstddef>
#include <vector>

#include "planner/coordination/priority.hpp"

namespace hlc::coordination {

/// The same order with as few couplings cut as a greedy choice needs for no more than `max_levels`
/// computation levels: from the nearest coupled pair on (distance of the planned positions at
/// t(k+1), then smaller ids), two groups become one if it has no more levels. Vehicles of different
/// groups plan at the same time.
///
/// For the study of how few levels suffice.
/// @param order  all vehicles of the situation, and perhaps others
/// @pre max_levels >= 1
[[nodiscard]] PriorityOrder grouped(const PrioritySituation& situation,
                                    std::vector<VehicleId> order, std::size_t max_levels);

}  // namespace hlc::coordination
