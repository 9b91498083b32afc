#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hlc_bridge/lab_control/lab_run.hpp"
#include "hlc_bridge/lab_control/progress_times.hpp"
#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"

namespace hlc::lab_control {

/// Participants of the lab's and the controllers' domain, and readers of the triggers.
struct LabControlPresence {
  machine::Participants participants;
  machine::Matched trigger_readers;
};

/// Progress of the run, in one line for the operator.
struct ProgressText {
  std::string text;
};

/// The part of the lab control centre that a run needs: answers the parameter requests, lets a
/// LabRun decide on the course of the run, and leaves when all participants have the stop symbol. A
/// StopSignal ends the run soon, with the stop symbol.
class LabControlMachine {
 public:
  using Event = std::variant<ReadyStatus, ReportRecord, VehicleState, StopRequest, ParameterRequest,
                             LabControlPresence, machine::StopSignal>;
  /// ReportRecord: to be recorded. Log: for the operator; the publisher adds the time stamp.
  using Action = std::variant<Parameter, ReportRecord, Log, RunState, SystemTrigger, ProgressText,
                              machine::LogLine>;

  /// @param run                in logical or in real time
  /// @param progress_interval  wall time from one ProgressText to the next
  LabControlMachine(std::unique_ptr<LabRun> run, Nanoseconds progress_interval)
      : run_(std::move(run)), progress_(progress_interval) {}

  void on(Event event);
  [[nodiscard]] std::vector<Action> advance(const Instant& now);
  [[nodiscard]] WakeUp wake_up() const;
  [[nodiscard]] std::size_t awaited() const;
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }

  [[nodiscard]] const LabRun& run() const { return *run_; }

  /// Waiting time after the end of the run for the others to leave: a process that receives the
  /// stop symbol before the lab control is gone leaves without an error.
  static constexpr Nanoseconds kLeaveTime = 800 * kNanosecondsPerMillisecond;
  static constexpr Nanoseconds kHurriedLeaveTime = 200 * kNanosecondsPerMillisecond;

 private:
  using Actions = std::vector<Action>;

  void take(const ReadyStatus& status) { run_->ready(status); }
  void take(ReportRecord record);
  void take(const VehicleState& state) { run_->state(state); }
  void take(const StopRequest& request) { run_->stop_requested(request.vehicle_id); }
  void take(const ParameterRequest& request);
  void take(LabControlPresence presence);
  void take(const machine::StopSignal& /*signal*/) { run_->interrupt(); }

  void append(const LabRunActions& todo, Nanoseconds wall, Actions& actions);
  void show_progress(Nanoseconds wall, Actions& actions);
  void leave(Nanoseconds wall);

  std::unique_ptr<LabRun> run_;
  ProgressTimes progress_;
  Actions replies_;  ///< to the messages since the last advance
  std::size_t num_trigger_readers_{};
  std::optional<Nanoseconds> began_;      ///< wall time of the first trigger
  std::optional<Nanoseconds> leaves_at_;  ///< wall; once the run has finished
  std::optional<int> exit_code_;
};

}  // namespace hlc::lab_control
