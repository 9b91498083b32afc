#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "planner/coordination/plan.hpp"

namespace hlc::controller {

/// Area of a vehicle that drives `plan` during the step, or drops its command then and brakes: the
/// announced area, and, from its pose at the beginning and at the end of the step, the area of
/// braking straight on.
///
/// The lab's stop law takes a vehicle of 0.4 ... 1.2 m/s on by 0.20 ... 0.24 s times its speed, up
/// to 40 mm to the inside of a curve, never to its outside.
[[nodiscard]] ConvexPolygon driven_or_braked_area(const coordination::Plan& plan,
                                                  const coordination::OccupiedAreas& announced,
                                                  StepIndex step,
                                                  const vehicle::VehicleParameters& vehicle);
/// Area of braking straight on from the pose to standstill. @param pose  yaw
[[nodiscard]] ConvexPolygon braking_area(const Pose& pose, double speed_mps,
                                         const vehicle::VehicleParameters& vehicle);

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

  /// @pre `in` does not decrease
  void add(coordination::Plan plan, coordination::OccupiedAreas announced, StepIndex in);
  /// The list of step `now` shows the vehicle: plans that it can no longer drive are removed. A
  /// vehicle that is not seen may stand anywhere on any of them.
  /// @param drivable_steps  of the controller (command_time.hpp)
  void forget(StepIndex now, std::uint64_t drivable_steps);
  /// In step `now` it is unknown which of the plans until then the vehicle drives.
  void doubt(StepIndex now) { doubted_until_ = now; }

  /// Those that are in doubt, and may still be driven; in the order of time.
  [[nodiscard]] std::vector<const Former*> doubtful() const;

 private:
  std::vector<std::shared_ptr<const Former>> formers_;
  std::optional<StepIndex> doubted_until_;
};

}  // namespace hlc::controller
