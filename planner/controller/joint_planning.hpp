#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "planner/controller/controller.hpp"

namespace hlc::controller {

/// Plans of all vehicles that matter to one controller, computed by itself from their traffic.
///
/// A plan takes microseconds, a message a hundred times as long. So instead of waiting for its
/// predecessors' predictions a controller computes them: planning is a function of this step's
/// traffic, bit for bit, and what does not change is compared by its digest
/// (PlanningInput::basis). A vehicle matters if it is coupled with the own one, or plans before one
/// that matters and is coupled with it.
///
/// What is computed for another vehicle is a guess: this controller may have received other traffic
/// than that one. The owner of this object must not rely on it before the other one has confirmed
/// it (TwoRounds).
///
/// Each search has the whole budget of its vehicle (SearchOptions::max_expansions), so a step of n
/// vehicles that matter takes up to n times as long as one of the own vehicle.
class JointPlanning {
 public:
  explicit JointPlanning(ControllerFactory others) : others_(std::move(others)) {}

  /// Whether those who make controllers as this one does can plan for the own vehicle from this
  /// traffic of it. Not if its subgraph has been changed, or while it is not seen.
  [[nodiscard]] bool can_be_planned_for(const Controller& own,
                                        const coordination::Traffic& traffic);

  /// The vehicles of the component that cannot be planned for: those that have not published a
  /// planning input, or one on another basis than this controller knows of them. The same in all
  /// controllers that received the same, as far as their bases agree. @param own  after `couple`
  [[nodiscard]] std::vector<VehicleId> prepare(const Controller& own);

  /// Plans for all vehicles that matter, the own one included, in the order of their priorities,
  /// after that of the component has been chosen (order_of_component.hpp).
  /// @pre `prepare` returned none, in the same step
  [[nodiscard]] coordination::ReceivedMessages<coordination::Prediction> plan(Controller& own);

 private:
  /// May be none.
  [[nodiscard]] Controller* replica_of(VehicleId vehicle, const Controller& own);
  [[nodiscard]] bool can_plan(VehicleId vehicle, const Controller& own);
  [[nodiscard]] std::vector<VehicleId> vehicles_that_matter(const Controller& own) const;

  ControllerFactory others_;
  std::map<VehicleId, std::unique_ptr<Controller>> replicas_;
};

}  // namespace hlc::controller
