#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/controller/control_loop.hpp"

namespace hlc::controller {

/// One message to one receiver, for rules that lose some.
struct Delivery {
  MessageKind kind;
  StepIndex step;
  VehicleId from;
  VehicleId to;
};

/// Messages of vehicles that are not stepped.
struct ExternalMessages {
  std::vector<coordination::Traffic> traffic{};
  std::vector<coordination::Prediction> predictions{};  ///< available before any vehicle plans
  std::vector<coordination::Outcome> outcomes{};
};

/// Conditions of a joint step.
struct JointStepRules {
  /// Messages for which this is true do not arrive. Absent: none. Asked once for each receiver.
  std::function<bool(const Delivery&)> is_lost{};
  /// Controllers for which this is true miss the step's deadline: they neither plan nor publish
  /// anything more in this step, and their plan in force stays. Absent: none. Called once per step.
  std::function<bool(const Controller&)> is_late{};
  /// Receives the traffic that a controller publishes, before any controller plans: its plan in
  /// force is still the one that the step began with. May be absent.
  std::function<void(const Controller&, const coordination::Traffic&)> on_traffic{};
  /// Receives the prediction of a controller, before the commit. May be absent.
  std::function<void(const Controller&, const coordination::Prediction&)> on_prediction{};
  /// Calls its argument, by which a controller plans; for an owner who measures. Absent: called
  /// directly.
  std::function<void(const std::function<void()>&)> around_planning{};
  ExternalMessages external{};
  /// Of controllers without a loop of their owner. kTwo: each makes its replicas in each step.
  Rounds rounds{Rounds::kSequential};
};

/// One control step of controllers that receive each other's messages in memory, each with the same
/// observation. Each plans after those that it has to wait for. Where priorities compare orders by
/// their plans (order_of_component.hpp), the controllers choose one together, if none misses
/// another; those with two rounds each for itself.
///
/// @param loops  each controller with a plan in force, none in a step
/// @return their reports, in the same order
std::vector<coordination::Report> joint_step(std::span<ControlLoop* const> loops,
                                             const Observation& observation,
                                             const JointStepRules& rules = {});

/// The same for controllers without a loop of their owner.
std::vector<coordination::Report> joint_step(std::span<Controller* const> controllers,
                                             const Observation& observation,
                                             const JointStepRules& rules = {});

}  // namespace hlc::controller
