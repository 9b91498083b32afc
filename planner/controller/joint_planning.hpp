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
/// it (ControlLoop).
class JointPlanning {
 public:
  explicit JointPlanning(ControllerFactory others) : others_(std::move(others)) {}

  /// The vehicles of the component that cannot be planned for: those that have not published a
  /// planning input, or one on another basis than this controller knows of them. The same in all
  /// controllers that received the same, as far as their bases agree. @param own  after `couple`
  [[nodiscard]] std::vector<VehicleId> prepare(const Controller& own);

  /// Plans for all vehicles that matter, the own one included, in the order of their priorities.
  /// @pre `prepare` returned none, in the same step
  [[nodiscard]] coordination::ReceivedMessages<coordination::Prediction> plan(Controller& own);

 private:
  [[nodiscard]] bool can_plan(VehicleId vehicle, const Controller& own);
  [[nodiscard]] std::vector<VehicleId> vehicles_that_matter(const Controller& own) const;

  ControllerFactory others_;
  std::map<VehicleId, std::unique_ptr<Controller>> replicas_;
};

}  // namespace hlc::controller
