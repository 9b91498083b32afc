#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "planner/coordination/coupling.hpp"

namespace hlc::coordination {

/// Constant priorities, the same for all vehicles of a run: smaller ids first, except for some
/// vehicles that plan before all others.
class PriorityRule {
 public:
  PriorityRule() = default;
  /// @param first  plan before all others, in this order; none twice
  explicit PriorityRule(std::vector<VehicleId> first) : first_(std::move(first)) {}

  [[nodiscard]] const std::vector<VehicleId>& first() const { return first_; }
  /// True if a plans before b: a strict total order.
  [[nodiscard]] bool operator()(VehicleId a, VehicleId b) const;
  friend bool operator==(const PriorityRule&, const PriorityRule&) = default;

 private:
  std::vector<VehicleId> first_;
};

/// Coupled vehicles that plan before `vehicle`, sorted by id: it waits for their predictions and
/// respects them.
[[nodiscard]] std::vector<VehicleId> predecessors(const CouplingGraph& graph, VehicleId vehicle,
                                                  const PriorityRule& plans_before);

/// Computation level of each vehicle: 0 without predecessors, otherwise one more than the largest
/// level among them. Vehicles of one level plan at the same time.
[[nodiscard]] std::map<VehicleId, std::uint32_t> computation_levels(
    const CouplingGraph& graph, const PriorityRule& plans_before);

}  // namespace hlc::coordination
