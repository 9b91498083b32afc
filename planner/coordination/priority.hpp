#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "planner/coordination/coupling.hpp"

namespace hlc::coordination {

/// True if a plans before b. A rule is one function, a strict total order of the vehicles, and the
/// same for all vehicles of a run.
using PriorityRule = bool (*)(VehicleId a, VehicleId b);

/// Constant priorities.
[[nodiscard]] bool smaller_id_first(VehicleId a, VehicleId b);

/// Coupled vehicles that plan before `vehicle`, sorted by id: it waits for their predictions and
/// respects them.
[[nodiscard]] std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                                  PriorityRule plans_before);

/// Computation level of each vehicle: 0 without predecessors, otherwise one more than the largest
/// level among them. Vehicles of one level plan at the same time.
[[nodiscard]] std::map<VehicleId, std::uint32_t> computation_levels(const CouplingGraph& graph,
                                                                    PriorityRule plans_before);

}  // namespace hlc::coordination
