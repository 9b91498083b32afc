#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/controller/control_loop.hpp"

namespace hlc {

/// One message on its way, for whoever loses some.
struct Delivery {
  MessageKind kind;
  StepIndex step;
  VehicleId from;
  VehicleId to;
};

/// What vehicles publish that are not stepped.
struct ExternalMessages {
  std::vector<Traffic> traffic{};
  std::vector<Prediction> predictions{};  ///< there before anybody plans
  std::vector<Outcome> outcomes{};
};

/// What happens around a joint step.
struct JointStepRules {
  /// Messages for which this is true do not arrive. Absent: none. Asked once for each receiver.
  std::function<bool(const Delivery&)> is_lost{};
  /// Controllers for which this is true miss the step's deadline: they neither plan nor publish
  /// anything more in this step, and their plan in force stays. Absent: none. Asked once per step.
  std::function<bool(const Controller&)> is_late{};
  /// Sees what a controller publishes of itself, before anybody plans: its plan in force is still
  /// the one that the step began with. Absent: nobody looks.
  std::function<void(const Controller&, const Traffic&)> on_traffic{};
  /// Sees what a controller predicts, before anybody decides whether it comes into force. Absent:
  /// nobody looks.
  std::function<void(const Controller&, const Prediction&)> on_prediction{};
  /// Calls what it is given, by which a controller plans; for an owner who measures. Absent: just
  /// calls it.
  std::function<void(const std::function<void()>&)> around_planning{};
  ExternalMessages external{};
};

/// One control step of controllers that receive each other's messages in memory, each with the same
/// observation. Vehicles plan in the order of their priorities, so that nobody waits.
///
/// @param loops  in the order of priorities (plans_before); each controller with a plan in force,
/// none in a step
/// @return their reports, in the same order
std::vector<Report> joint_step(std::span<ControlLoop* const> loops, const Observation& observation,
                               const JointStepRules& rules = {});

/// The same for controllers whose owner keeps no loops.
std::vector<Report> joint_step(std::span<Controller* const> controllers,
                               const Observation& observation, const JointStepRules& rules = {});

}  // namespace hlc
