#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "planner/controller/controller.hpp"

namespace hlc {

enum class MessageKind { kTraffic, kPrediction, kOutcome };

/// One message on its way, for whoever loses some.
struct Delivery {
  MessageKind kind;
  StepIndex step;
  VehicleId from;
  VehicleId to;
};

/// What vehicles say that are not stepped.
struct SaidOutside {
  std::vector<Traffic> traffic{};
  std::vector<Prediction> predictions{};  ///< there before anybody plans
  std::vector<Outcome> outcomes{};
};

/// What happens around a joint step.
struct JointStepRules {
  /// Messages for which this says true do not arrive. Absent: none.
  std::function<bool(const Delivery&)> is_lost{};
  /// Controllers for which this says true miss the step's deadline: they neither plan nor say
  /// anything more in this step, and their plan in force stays. Absent: none. Asked once per step.
  std::function<bool(const Controller&)> is_late{};
  /// Sees what a controller tells of itself, before anybody plans: its plan in force is still the
  /// one that the step began with. Absent: nobody looks.
  std::function<void(const Controller&, const Traffic&)> told{};
  /// Calls Controller::plan, for an owner who wants to measure. Absent: just calls it.
  std::function<Prediction(Controller&, std::span<const Prediction>)> plan{};
  SaidOutside outside{};
};

/// One control step of controllers that hear each other in memory, each with the same observation.
/// Vehicles plan in the order of their priorities, so that nobody waits.
///
/// @param controllers  in the order of priorities (plans_before); each with a plan in force
/// @return their reports, in the same order
std::vector<Report> joint_step(std::span<Controller* const> controllers,
                               const Observation& observation, const JointStepRules& rules = {});

}  // namespace hlc
