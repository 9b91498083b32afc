#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/lab_control/attendance.hpp"
#include "hlc_bridge/lab_control/reported_steps.hpp"
#include "hlc_bridge/lab_control/standing_vehicles.hpp"
#include "hlc_bridge/messages/death.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/instant.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::lab_control {

/// Reaction of the run to the death of a process.
enum class OnDeath : std::uint8_t {
  kStop,      ///< the others make a minimal-risk stop, and the run ends
  kContinue,  ///< the run continues, and the dead process may return (real time only)
};

struct LabRunSettings {
  std::vector<std::uint8_t> vehicle_ids;
  std::vector<std::uint8_t> guest_ids{};  ///< further vehicles, without controller and middleware
  Nanoseconds period{200'000'000};
  std::uint64_t steps{150};
  Nanoseconds startup_timeout{20 * kNanosecondsPerSecond};
  OnDeath on_death{OnDeath::kStop};

  /// Of the vehicles, then of the guests.
  [[nodiscard]] std::vector<std::uint8_t> all_ids() const {
    std::vector<std::uint8_t> ids = vehicle_ids;
    ids.insert(ids.end(), guest_ids.begin(), guest_ids.end());
    return ids;
  }
};

/// Duration of the minimal-risk stop after a death, until the stop symbol.
inline constexpr Nanoseconds kMinimalRiskStopTime = 3 * kNanosecondsPerSecond;
/// Vehicles brake for 50 ticks after the stop symbol; one more tick may have begun.
inline constexpr Nanoseconds kBrakingTime = 51 * kVehiclePeriod;
/// A process with a reply pending for this long (wall time, since the last reply of any process) is
/// dead. Longer than kMessageTimeout, so that processes that wait for the dead one have timed out
/// and replied before: only the cause is still silent then.
inline constexpr Nanoseconds kAnswerTimeout = kMessageTimeout + 2 * kNanosecondsPerSecond;
/// From the start on, controllers must leave standby within this time of the run.
inline constexpr Nanoseconds kStandbyTimeout = 10 * kNanosecondsPerSecond;
/// Wall time for the end of an interrupted run.
inline constexpr Nanoseconds kInterruptTime = 700'000'000;

/// Actions of the lab control, in this order.
struct LabRunActions {
  std::vector<Death> deaths;         ///< for the log and the operator
  std::vector<std::string> returns;  ///< dead processes that are back; for the log and the operator
  std::vector<std::string> stuck;    ///< a line for each vehicle that has become stuck; for the log
  std::vector<std::string> arrived;  ///< likewise at its goal
  std::optional<RunPhase> run_state;  ///< to be published
  std::vector<Nanoseconds> triggers;  ///< SystemTriggers to be sent, in this order
};

struct LabRunResult {
  int exit_code{kExitGood};
  std::string reason;  ///< one line; empty on success
  /// In the order of detection, but a middleware before its controller: the controller leaves when
  /// its middleware is lost, and may detect that earlier than the lab control.
  std::vector<Death> deaths;
  std::optional<std::uint64_t> first_step;  ///< k0: first step reported as not standby
  Nanoseconds wall{};   ///< wall time from the first trigger to the last answer before the stop
  Nanoseconds clock{};  ///< time of the run that passed meanwhile
};

/// The course of one run as a state machine without clock, thread or network: the lab control's
/// machine (LabControlMachine) passes on arriving messages, calls advance() after them and at
/// wake_up(), and executes the returned actions.
///
///     gathering ──all ready──► running ──(k0 + steps + 1) periods──► braking ──1 s──► finished (0)
///         │                       ├──death──► minimal-risk stop ──3 s──► braking ──► finished (4)
///         └──timeout──► finished (3)    nobody leaves standby for 10 s ► braking ──► finished (3)
///
/// With OnDeath::kContinue a death is recorded, and the run continues. A dead process is back when
/// its participant is present again, a controller when it reports again (one that died on standby:
/// when it drives); a run that ends while a
/// dead process is not back has failed (4).
///
/// Step k0 is the first that a controller reports as not standby. The run continues for one period
/// after the last of its `steps` steps, so that the pose at the end of that step is recorded, too;
/// a run in which a controller never leaves standby has failed (3). A run that was driven to its
/// end ends with 6 if a vehicle is stuck then (planner/coordination/waiting.hpp). An interruption
/// or a controller's stop request leads from any phase to braking. The two kinds of run, LogicalRun
/// and RealTimeRun, define how time advances.
class LabRun {
 public:
  enum class Phase : std::uint8_t { kGathering, kRunning, kMinimalRiskStop, kBraking, kFinished };

  explicit LabRun(LabRunSettings settings);
  virtual ~LabRun() = default;
  LabRun(const LabRun&) = delete;
  LabRun& operator=(const LabRun&) = delete;

  /// Live and lost participants; a name in both is lost.
  void presence(const std::set<std::string>& alive, const std::set<std::string>& lost) {
    attendance_.update(alive, lost);
  }
  /// Readers of the lab control's triggers: before the run begins all timers, every vehicle and
  /// every middleware must be among them, so that the first trigger is not lost.
  void trigger_readers(std::set<std::string> names) {
    attendance_.trigger_readers(std::move(names));
  }
  virtual void ready(const ReadyStatus& status) = 0;
  virtual void state(const VehicleState& /*state*/) {}
  void report(const ReportRecord& record);
  void interrupt();
  void stop_requested(std::uint8_t vehicle_id);

  /// @param now  wall time. Real time: since the epoch. Logical time: any. If the clock is set
  ///     back, time stands still until it has caught up.
  [[nodiscard]] LabRunActions advance(Nanoseconds now);
  /// Wall time at which advance() must be called even if nothing arrives; kNever: none.
  [[nodiscard]] Nanoseconds wake_up() const;
  /// The same by the clocks of a machine: the wall time that counts here, and back.
  [[nodiscard]] virtual Nanoseconds time_of(const Instant& now) const { return now.wall; }
  [[nodiscard]] virtual WakeUp wake_up_at(Nanoseconds time) const { return {.wall = time}; }
  /// Real time: next_start of the start trigger; 0: there is none.
  [[nodiscard]] virtual Nanoseconds start() const { return 0; }
  /// Logical time: only the run's triggers advance time.
  [[nodiscard]] virtual bool releases_time() const = 0;
  /// The run begins only with states of all vehicles.
  [[nodiscard]] virtual bool awaits_states() const { return false; }
  /// Number of replies without which advance() has nothing to do, once the run has begun; 0 if any
  /// message may count.
  [[nodiscard]] std::size_t pending_answers() const {
    return phase_ == Phase::kGathering ? 0 : num_messages(pending_replies());
  }

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] bool finished() const { return phase_ == Phase::kFinished; }
  /// Steps that have begun, 0 before k0; at most `steps`.
  [[nodiscard]] std::uint64_t steps_begun() const;
  /// Before the beginning: "missing: a, b; not ready: c".
  [[nodiscard]] std::string waiting_for() const;
  /// Complete once finished.
  [[nodiscard]] const LabRunResult& result() const { return result_; }
  [[nodiscard]] const LabRunSettings& settings() const { return settings_; }

  static constexpr Nanoseconds kNever = ~Nanoseconds{0};

 protected:
  /// Processes that are not yet ready; empty: the run can begin.
  [[nodiscard]] virtual std::vector<std::string> not_ready() const = 0;
  /// Triggers that are due. Called at every advance from the beginning on.
  virtual void go_on(LabRunActions& actions) = 0;
  /// Time of the run up to which everything is done; kNever without a process to advance time for.
  [[nodiscard]] virtual Nanoseconds clock() const = 0;
  /// Processes that are dead although their participant is alive, with the evidence; and when the
  /// next such death is due if no message arrives (wall time).
  [[nodiscard]] virtual std::vector<Death> overdue() const { return {}; }
  [[nodiscard]] virtual Nanoseconds next_overdue() const { return kNever; }
  /// Whether the vehicle's controller should have left standby by now: one that died for this is
  /// not back as long as it only reports that it is on standby.
  [[nodiscard]] virtual bool is_drive_overdue(std::uint8_t /*vehicle_id*/) const { return false; }
  /// Processes with a pending reply. When no process has replied for kAnswerTimeout, those of them
  /// are dead that are not present: the others may wait for these. If all are present, all are.
  [[nodiscard]] virtual std::vector<std::string> pending_replies() const { return {}; }
  /// Messages in which these processes reply: one that serves several vehicles sends one for all.
  [[nodiscard]] virtual std::size_t num_messages(const std::vector<std::string>& processes) const {
    return processes.size();
  }
  /// The process is gone. Before the beginning it may return, and starts again.
  virtual void drop(const std::string& /*process*/) {}
  /// The process, dropped before, is back.
  virtual void on_return(const std::string& /*process*/) {}
  /// Wall time at which clock() itself reaches `t`; kNever if that takes an answer.
  [[nodiscard]] virtual Nanoseconds wall_time_of(Nanoseconds /*t*/) const { return kNever; }

  /// To be called for every reply that advances the run.
  void note_progress() { progress_ = true; }
  [[nodiscard]] Nanoseconds now() const { return now_; }
  [[nodiscard]] const ReportedSteps& reports() const { return reports_; }

 private:
  /// Begin of the phase by the wall clock and by clock() (0: no process to advance time for).
  struct Since {
    Nanoseconds wall{};
    Nanoseconds clock{};
  };

  void enter(Phase phase);
  void note_time(Nanoseconds now);
  void gather(LabRunActions& actions);
  void update_deaths(LabRunActions& actions);
  void update_returns(LabRunActions& actions);
  [[nodiscard]] bool is_back(const std::string& process) const;
  [[nodiscard]] std::vector<std::string> silent_among(
      const std::vector<std::string>& pending) const;
  void mark_dead(const std::string& process, const std::string& sign, LabRunActions& actions);
  void record_death(const Death& death);
  void leave_running_phases(LabRunActions& actions);
  void stop(LabRunActions& actions);
  void fail(int exit_code, const std::string& reason);
  [[nodiscard]] std::string standby_line() const;
  /// Time of the run at which the present phase ends; kNever if an answer decides.
  [[nodiscard]] Nanoseconds phase_end() const;

  LabRunSettings settings_;
  Phase phase_{Phase::kGathering};
  Since phase_since_;    ///< the present phase
  Since running_since_;  ///< Phase::kRunning
  LabRunResult result_;
  Attendance attendance_;
  ReportedSteps reports_;
  StandingVehicles standing_;
  bool is_end_requested_{};  ///< interrupted, or a controller requested the stop
  bool progress_{};
  bool started_{};
  Nanoseconds now_{};
  Nanoseconds last_progress_{};  ///< wall
};

/// One of the two kinds of run.
template <class Run>
[[nodiscard]] std::unique_ptr<LabRun> make_lab_run(LabRunSettings settings) {
  return std::make_unique<Run>(std::move(settings));
}

}  // namespace hlc::lab_control
