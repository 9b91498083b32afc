#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// Area of a vehicle that drives `plan` during the step, or drops its command then and brakes: the
/// announced area, and the areas of braking from its pose at the beginning and at the end of the
/// step.
///
/// The lab's stop law takes a µCar of 0.4 ... 1.2 m/s on by 0.20 ... 0.24 s times its speed, up to
/// 40 mm to the inside of a curve, never to its outside: for it the area is that of braking
/// straight on for 0.25 s times the speed. A vehicle with a servo that needs time to turn goes on
/// in its curve for a while: its area is that of the stop law
/// (planner/vehicle/identified_motion.hpp), from the planned speed and steering on, after the
/// inputs under way, which keep the speed.
[[nodiscard]] ConvexPolygon driven_or_braked_area(const coordination::Plan& plan,
                                                  const coordination::OccupiedAreas& announced,
                                                  StepIndex step,
                                                  const automaton::UniversalAutomaton& automaton);
/// Area of braking from the pose to standstill.
/// @param pose          yaw
/// @param steering_rad  at first; of no account where the servo turns within a tick
[[nodiscard]] ConvexPolygon braking_area(const Pose& pose, double speed_mps, double steering_rad,
                                         const automaton::UniversalAutomaton& automaton);

/// Plans that were in force before the present one, each as long as the vehicle may still drive it:
/// the commands of the newer ones may have been lost. A value; copies share the plans.
class ReplacedPlans {
 public:
  struct Former {
    coordination::Plan plan;
    /// As the others knew them, from the step before it came into force
    coordination::OccupiedAreas announced;
    StepIndex replaced_in;
  };

  /// @param drivable_steps  after the one in which a plan is replaced (command_time.hpp); 0 where
  ///                        none is
  explicit ReplacedPlans(std::uint64_t drivable_steps) : drivable_steps_(drivable_steps) {}

  /// @pre `in` does not decrease
  void add(coordination::Plan plan, coordination::OccupiedAreas announced, StepIndex in);
  /// The list of step `now` shows the vehicle: plans that it can no longer drive are removed. A
  /// vehicle that is not seen may stand anywhere on any of them.
  void forget(StepIndex now);
  /// In step `now` it is unknown which of the plans until then the vehicle drives.
  void doubt(StepIndex now) { doubted_until_ = now; }

  /// Those that are in doubt, and may still be driven; in the order of time.
  [[nodiscard]] std::vector<const Former*> doubtful() const;

 private:
  std::uint64_t drivable_steps_;
  std::vector<std::shared_ptr<const Former>> formers_;
  std::optional<StepIndex> doubted_until_;
};

}  // namespace hlc::controller
