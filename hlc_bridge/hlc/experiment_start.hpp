#pragma once

#include <map>
#include <optional>

#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::high_level_controller {

/// When the experiment starts or started, as far as this controller knows. The start trigger is
/// sent once: a controller that was absent then learns of the start from the lab control's run
/// state, if the lab control is ours, or from the others' traffic.
class ExperimentStart {
 public:
  ExperimentStart(VehicleId vehicle, StartRule rule, Nanoseconds step)
      : vehicle_(vehicle), rule_(rule), step_ns_(step) {}

  /// The first known start counts.
  void trigger(Nanoseconds next_start);
  void receive(const RunState& state);
  void receive(const coordination::Traffic& traffic) {
    newest_traffic_[traffic.vehicle] = traffic.step;
  }

  /// To be called before a list is answered. Only a controller that drives sends traffic, so the
  /// experiment is running if another active vehicle's traffic is of about this time. Traffic of
  /// inactive vehicles, or of another time, is not evidence. Without a lab control it is not
  /// joined: a controller that has never seen one could not miss it (LabControlWatch), and nobody
  /// could stop its vehicle.
  /// @return true the first time that it is not joined for that reason
  bool join_if_others_drive(const controller::Observation& observation, bool has_lab_control);

  /// next_start of the trigger; for an experiment that was already running, a time since which it
  /// runs.
  [[nodiscard]] const std::optional<Nanoseconds>& time() const { return time_; }

  /// The controller enters the experiment with the step of this list.
  void enter(StepIndex step);
  /// The experiment's first step, once this controller has entered it. Under kAtTrigger the
  /// trigger's step, the same for all: a controller that returns later counts from there, too.
  [[nodiscard]] const std::optional<StepIndex>& first_step() const { return first_step_; }
  /// True if a controller that enters with this list was absent at the start.
  [[nodiscard]] bool is_joining(const VehicleStateList& list) const;

 private:
  static constexpr Nanoseconds kLateSteps = 2;  ///< after the trigger's time

  VehicleId vehicle_;
  StartRule rule_;
  Nanoseconds step_ns_;
  std::map<VehicleId, StepIndex> newest_traffic_;
  std::optional<Nanoseconds> time_;
  bool is_inferred_{};  ///< from the others' traffic
  bool was_kept_out_{};
  std::optional<StepIndex> first_step_;
};

}  // namespace hlc::high_level_controller
