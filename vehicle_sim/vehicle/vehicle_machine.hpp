#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/machine/lab_control_watch.hpp"
#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/machine/pacing_rules.hpp"
#include "hlc_bridge/machine/stamp_check.hpp"
#include "hlc_bridge/machine/start_up.hpp"
#include "hlc_bridge/machine/ticks.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::simulated_vehicle {

struct VehicleMachineOptions {
  SimulatedVehicleOptions vehicle;
  machine::PacingRules rules;
  /// The lab's own programs may be present: its middleware has another name, and its controllers do
  /// not answer before the start.
  bool is_among_lab_programs{};
  /// Vehicles of the run without controller and middleware, this one or others.
  std::vector<std::uint8_t> guest_ids{};
  bool keep_running{};  ///< after a stop brake, then listen again instead of ending
  /// Logical time, without readers but our middlewares: one tick a period stands for all since the
  /// last one, and only the states that the lists hold are published.
  bool ticks_by_period{};
  Nanoseconds startup_timeout{30 * kNanosecondsPerSecond};  ///< wall
};

/// Presence and matches on the lab domain.
struct VehiclePresence {
  machine::Participants lab;
  machine::Matched state_readers;
  machine::Matched command_writers;  ///< of trajectories
  std::size_t ready_readers{};
  std::size_t trigger_writers{};
};

/// One simulated vehicle of a run: every 20 ms one step of `SimulatedVehicle` with the received
/// commands, and its state.
///
/// If the rules require it, it gets period and active vehicles from the lab control before its
/// first tick and waits for all its endpoints to be matched, and each tick waits for the answer to
/// the last list before it (not that of a guest, which has no controller); that wait ends when the
/// middleware or the controller is lost, or after the patience (then they are not awaited until a
/// command is received again).
///
/// A command whose create_stamp is not plausible (StampCheck) is dropped, because it would replace
/// every later command. It is no answer to a list.
///
/// A tick that is too late is made up for (the plant must keep up with the clock), but its state is
/// not published.
///
/// With ticks_by_period the tick at k * period makes up for those since the one before, until the
/// stop symbol: the motion is the same, and the run has a tenth of the messages.
///
/// The stop symbol: it brakes for a second, then ends (kExitGood), or listens again. Without the
/// lab control it ends after the rules' grace period (kExitDied).
class VehicleMachine {
 public:
  using Event =
      std::variant<TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand, DirectCommand,
                   Parameter, SystemTrigger, VehiclePresence, machine::StopSignal>;
  /// VehicleObservation: for the camera system's readers, if there are any. DrivenSample: for the
  /// record of the true motion.
  using Action = std::variant<ParameterRequest, VehicleState, VehicleObservation,
                              result::DrivenSample, machine::LogLine>;

  /// @throws std::invalid_argument if the start pose is not finite
  explicit VehicleMachine(const VehicleMachineOptions& options);

  /// Triggers other than the stop symbol have no effect: time comes from advance.
  void on(Event event);
  [[nodiscard]] std::vector<Action> advance(const Instant& now);
  [[nodiscard]] WakeUp wake_up() const;
  [[nodiscard]] std::size_t awaited() const;
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }
  /// Commands dropped because of their create_stamp.
  [[nodiscard]] std::uint64_t implausible_commands() const { return received_.check.dropped(); }

 private:
  using Command =
      std::variant<TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand, DirectCommand>;
  /// Commands are judged by the time of the next advance, because an event has none.
  struct Received {
    std::vector<Command> commands;  ///< since the last advance
    machine::StampCheck check;
    Nanoseconds newest_answer{};  ///< largest create_stamp of those not dropped
  };
  /// A tick that has begun and waits for its answer.
  struct PendingTick {
    Nanoseconds time{};
    Nanoseconds patience_ends{};  ///< wall
  };
  using Actions = std::vector<Action>;

  void take(TrajectoryCommand command) { received_.commands.emplace_back(std::move(command)); }
  void take(PathTrackingCommand command) { received_.commands.emplace_back(std::move(command)); }
  void take(SpeedCurvatureCommand command) { received_.commands.emplace_back(command); }
  void take(DirectCommand command) { received_.commands.emplace_back(command); }
  void take(const Parameter& parameter) { start_up_.take(parameter); }
  void take(const SystemTrigger& trigger);
  void take(VehiclePresence presence) { presence_ = std::move(presence); }
  void take(const machine::StopSignal& /*signal*/) { is_end_requested_ = true; }

  void receive_commands(const Instant& now, Actions& actions);
  [[nodiscard]] bool is_prepared(const Instant& now, Actions& actions);
  [[nodiscard]] std::string parameter_fault() const;
  [[nodiscard]] bool is_guest(std::int32_t id) const;
  [[nodiscard]] bool is_connected() const;
  [[nodiscard]] std::string who_is_missing() const;
  [[nodiscard]] bool awaits_answer(const PendingTick& tick, const Instant& now, Actions& actions);
  [[nodiscard]] bool is_answered(Nanoseconds list) const;
  void run_tick(Nanoseconds t_now, Actions& actions);
  void begin_ticks(Nanoseconds period, const Instant& now);
  [[nodiscard]] bool is_in_list(Nanoseconds t) const;
  void brake_if_stopped(Actions& actions);
  void make_up_for_missed_ticks(Nanoseconds t_now, Actions& actions);
  void log_why_it_stops(const SimulatedVehicle::Tick& done, Actions& actions);
  void watch_lab_control(Nanoseconds wall, Actions& actions);
  void fail(int exit_code, std::string line, Actions& actions);

  VehicleMachineOptions options_;
  SimulatedVehicle vehicle_;
  machine::StartUp start_up_;
  machine::LabControlGrace lab_control_;
  std::optional<machine::Ticks> ticks_;  ///< once it is prepared
  std::optional<PendingTick> pending_;
  std::optional<Nanoseconds> last_tick_;
  VehiclePresence presence_;
  Received received_;
  bool wait_timed_out_{};
  bool stop_symbol_{};       ///< received; the next tick brakes
  bool is_stopping_{};       ///< it brakes
  bool is_end_requested_{};  ///< at once
  tracking::FollowerStatus last_status_{tracking::FollowerStatus::kNoCommand};
  std::optional<int> exit_code_;
};

}  // namespace hlc::simulated_vehicle
