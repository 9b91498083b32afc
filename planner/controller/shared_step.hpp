#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "planner/coordination/coupling.hpp"
#include "planner/coordination/priority.hpp"
#include "planner/right_of_way/way_on.hpp"

namespace hlc::controller {

/// What controllers that received the same compute alike in a step: within one process it is
/// computed once. Keeps the last result with all that it depends on; for a controller that received
/// something else it is computed again, so sharing changes no result.
class SharedStep {
 public:
  struct Coupling {
    coordination::CouplingGraph graph;
    coordination::PriorityOrder plans_before;   ///< PriorityRule::assign
    std::map<VehicleId, std::uint32_t> levels;  ///< computation_levels
  };

  /// @param traffic  as for CouplingGraph; kept by address: must outlive this object, unchanged
  [[nodiscard]] const Coupling& coupling(std::vector<const coordination::Traffic*> traffic,
                                         const coordination::PriorityRule& priorities,
                                         const coordination::CouplingRule& rule);

  /// What each vehicle takes (right_of_way::leave_a_way_on) of what is granted to it
  /// (right_of_way::grant). @param holders  sorted by vehicle
  [[nodiscard]] const std::vector<right_of_way::Taken>& taken(
      const right_of_way::ConflictMap& map, const std::vector<right_of_way::Holder>& holders,
      std::span<const right_of_way::Blocked> blocked, double look_ahead_m,
      const right_of_way::GrantOrder& order);

 private:
  struct AllTaken {
    const right_of_way::ConflictMap* map;
    std::vector<right_of_way::Holder> holders;
    std::vector<right_of_way::Blocked> blocked;
    double look_ahead_m;
    const right_of_way::GrantOrder* order;
    std::vector<right_of_way::Taken> taken;
  };

  std::vector<const coordination::Traffic*> traffic_;  ///< of `coupling_`
  coordination::PriorityRule priorities_;
  const coordination::CouplingRule* rule_{};
  std::optional<Coupling> coupling_;
  std::optional<AllTaken> taken_;
};

}  // namespace hlc::controller
