#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/coordination/coupling.hpp"

namespace hlc::coordination {

/// Smaller plans earlier. Priorities of two vehicles differ.
struct Priority {
  std::uint32_t value{};
  friend auto operator<=>(const Priority&, const Priority&) = default;
};

/// Constant priorities: the vehicle with the smaller id plans earlier.
[[nodiscard]] Priority constant_priority(VehicleId vehicle);

[[nodiscard]] bool plans_before(VehicleId a, VehicleId b);

/// Coupled vehicles that plan before `vehicle`, sorted: it waits for their predictions and respects
/// them.
[[nodiscard]] std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle);

/// Computation level: 0 without predecessors, otherwise one more than the largest level among them.
/// Vehicles of one level plan at the same time.
[[nodiscard]] std::uint32_t computation_level(const CouplingGraph& graph, VehicleId vehicle);

}  // namespace hlc::coordination
