#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <vector>

#include "planner/coordination/coupling_rule.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::coordination {

/// Which vehicles are coupled by a rule (undirected). The result is the same in every controller
/// that received the same traffic.
class CouplingGraph {
 public:
  /// @param traffic  of the same step, every vehicle once; not kept
  explicit CouplingGraph(std::vector<const Traffic*> traffic,
                         const CouplingRule& rule = kReachableAreas);

  [[nodiscard]] const std::vector<VehicleId>& vehicles() const { return vehicles_; }
  [[nodiscard]] bool are_coupled(VehicleId a, VehicleId b) const;
  /// Coupled vehicles of `vehicle`, sorted.
  [[nodiscard]] std::vector<VehicleId> neighbours(VehicleId vehicle) const;
  /// All vehicles connected with `vehicle` over any number of couplings, itself included, sorted.
  [[nodiscard]] std::vector<VehicleId> component(VehicleId vehicle) const;

 private:
  [[nodiscard]] std::size_t index(VehicleId vehicle) const;

  std::vector<VehicleId> vehicles_;
  std::vector<boost::container::small_vector<std::size_t, 8>> neighbours_;  ///< each sorted
};

}  // namespace hlc::coordination
