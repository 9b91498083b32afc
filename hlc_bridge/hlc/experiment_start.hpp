#pragma once

#include <map>
#include <optional>

#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/controller/controller.hpp"

namespace hlc {

/// When the experiment starts or started, as far as one controller knows. The start trigger is sent
/// once: who was not there learns of it from the lab control's run state, if that is ours, or from
/// the others' traffic.
class ExperimentStart {
 public:
  ExperimentStart(VehicleId vehicle, StartRule rule, Nanoseconds step)
      : vehicle_(vehicle), rule_(rule), step_ns_(step) {}

  /// The first start learned of counts.
  void trigger(Nanoseconds next_start);
  void receive(const RunState& state);
  void receive(const Traffic& traffic) { newest_traffic_[traffic.vehicle] = traffic.step; }

  /// Before a list is answered: only who drives sends traffic, so the experiment runs if another
  /// active vehicle does, about this time. Who takes no part, or speaks of another time, says
  /// nothing about this experiment.
  void join_if_others_drive(const Observation& observation);

  /// next_start of the trigger; of an experiment that was running before, a time since which it is.
  [[nodiscard]] const std::optional<Nanoseconds>& time() const { return time_; }

  /// The controller enters the experiment with the step of this list.
  void enter(StepIndex step);
  /// The experiment's first step, once this controller has entered it. Under kAtTrigger the
  /// trigger's, the same for all: who comes back later counts from there, too.
  [[nodiscard]] const std::optional<StepIndex>& first_step() const { return first_step_; }
  /// True if a controller that enters with this list was not there at the start.
  [[nodiscard]] bool is_joining(const VehicleStateList& list) const;

 private:
  static constexpr Nanoseconds kLateSteps = 2;  ///< after the trigger's time

  VehicleId vehicle_;
  StartRule rule_;
  Nanoseconds step_ns_;
  std::map<VehicleId, StepIndex> newest_traffic_;
  std::optional<Nanoseconds> time_;
  bool is_inferred_{};  ///< from the others' traffic
  std::optional<StepIndex> first_step_;
};

}  // namespace hlc
