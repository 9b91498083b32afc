#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/middleware/command_check.hpp"
#include "hlc_bridge/middleware/state_buffer.hpp"
#include "hlc_bridge/time/logical_timer.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/timer.hpp"
#include "hlc_bridge/time/wait_notice.hpp"

namespace hlc {

struct MiddlewareOptions {
  /// For the log, and in logical time the source_id of the timer's ready status (wire contract,
  /// 5.3). On the domains the process always bears its vehicle's name (messages/node_names).
  std::string node_id;
  std::string version{};                  ///< ParticipantOptions::version
  std::vector<std::uint8_t> vehicle_ids;  ///< of its controllers; at least one
  Transport transport{Transport::kLab};
  int lab_domain{};
  int local_domain{};
  std::optional<DiscoveryServer> discovery_server;
  bool logical_time{};
  Nanoseconds offset{kListOffset};  ///< of the lists in a period
  /// After the stop symbol wait for the next experiment instead of ending (real time).
  bool keep_running{};
  std::chrono::seconds startup_timeout{30};
};

/// Stands between controllers (local domain; one, or those of several vehicles) and the vehicles
/// (lab domain).
///
/// Every period, at t_now = k P + offset, it writes a VehicleStateList with the newest valid state
/// of every active vehicle. Commands of a controller go on to its vehicle as soon as they come,
/// after a check (check_command); triggers of the lab control go on to the controllers
/// (loopback in logical time: only the first one and the stop symbol).
///
/// On the lab's transport, where controllers of others may be: commands of all four kinds, and
/// lists with the camera system's observations. On loopback: trajectories, which is what ours
/// sends.
///
/// Two threads: `run` keeps the period; a carrier forwards commands and triggers, so that neither
/// waits for the other.
///
/// Real time: lists come from the first period on, whoever is there. When all controllers are
/// ready, the lab control is told every period until its first trigger. With `keep_running` the
/// stop symbol ends the experiment, not the process: lists go on, commands are kept back until the
/// next trigger, controllers must say anew that they are ready, and the lab control is asked every
/// second for the next experiment's vehicles: it is told nothing before they are known.
///
/// Logical time: before its first tick all its endpoints are matched. A tick waits for the state of
/// every active vehicle that must be in the list, writes the list, and waits until every
/// controller's answer to it has been carried on: only then the next tick is asked for. Whoever is
/// gone is not waited for, nor who has been silent for 10 s, until he is heard again; nor, on the
/// lab's transport, who has not been heard yet, since the lab's controllers do not answer before
/// the start.
class MiddlewareProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit MiddlewareProcess(MiddlewareOptions options);
  ~MiddlewareProcess();

  /// Until the stop symbol has come (see keep_running), or `stop` is called. The exit code: 0 good,
  /// 2 if the lab control's parameters do not fit, 3 if somebody needed did not appear, 4 if the
  /// lab control is lost, or (logical time) sends no trigger any more.
  [[nodiscard]] int run();

  /// Ends `run` soon. From any thread.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  using Carried = std::variant<TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand,
                               DirectCommand, SystemTrigger>;
  /// What goes out to one vehicle.
  struct Vehicle;
  /// What only the lab's programs say and hear: on its transport.
  struct LabEndpoints;

  [[nodiscard]] int keep_period();
  [[nodiscard]] int prepare();
  void take(const SystemTrigger& trigger);
  [[nodiscard]] bool learn_parameters(Clock::time_point deadline);
  [[nodiscard]] std::string parameter_problem(const RunParameters& parameters) const;
  [[nodiscard]] bool knows_next_experiment();
  void ask_for_next_experiment();
  [[nodiscard]] bool wait_for_everybody(Clock::time_point deadline);
  void listen_to_vehicles();
  [[nodiscard]] bool is_connected() const;
  [[nodiscard]] std::size_t controllers_that_command() const;
  [[nodiscard]] std::string who_is_missing() const;
  void make_timer();
  void send_ready(Nanoseconds next_tick);

  void tick(Nanoseconds t_now);
  void wait_for_states(Nanoseconds t_now);
  void wait_for_answer(Nanoseconds t_now);
  void tell_missed_answer();

  void carry_everything();
  void carry_on(const SystemTrigger& trigger);
  template <class Command>
  void carry_on(const Command& command);
  void tell_faults(const CommandVerdict& verdict, std::uint8_t vehicle_id);
  void let_controllers_leave() const;
  void watch_lab_control(Nanoseconds t_now);

  MiddlewareOptions options_;

  Signal signal_;  // guards what follows, down to the next blank line; the period waits for it
  StateBuffer states_;
  std::set<std::uint8_t> silent_vehicles_;
  std::map<std::uint8_t, VehicleObservation> observations_;  ///< newest of each vehicle
  Nanoseconds newest_list_{};
  std::map<std::uint8_t, Nanoseconds> newest_answers_;  ///< of its vehicles: largest create_stamps
  std::set<std::uint8_t> silent_controllers_;
  std::set<std::uint8_t> ready_controllers_;
  bool triggered_{};
  bool between_experiments_{};  ///< the stop symbol has come, and no trigger since
  RunParameters next_;          ///< told since they were asked for last, between experiments
  bool knows_next_{};           ///< and once told and served since the stop symbol
  bool stop_{};
  bool stop_symbol_{};
  Timer* timer_in_use_{};
  LogicalTimer* logical_timer_{};  ///< the same in logical time
  RunParameters parameters_;

  Signal mail_;  // guards what follows, down to the next blank line; the carrier waits for it
  std::deque<Carried> to_carry_;
  bool carrier_ends_{};

  // Of the carrier:
  std::set<CommandFault> told_faults_;
  // Of the period:
  std::uint64_t missed_answers_{};
  WaitNotice wait_notice_;
  Clock::time_point next_request_{};
  std::string next_problem_;  ///< told last
  bool lab_control_lost_{};
  std::optional<Nanoseconds> lab_control_lost_at_;  ///< real time

  std::unique_ptr<Timer> timer_;

  // Destroyed first: no callback comes afterwards.
  Participant lab_;
  Participant local_;
  Writer<VehicleStateList> list_writer_;
  Writer<SystemTrigger> trigger_writer_;
  std::map<std::uint8_t, std::unique_ptr<Vehicle>> vehicles_;  ///< of the controllers
  Writer<ReadyStatus> ready_writer_;
  Writer<ParameterRequest> request_writer_;
  Reader<Parameter> parameter_reader_;
  Reader<SystemTrigger> trigger_reader_;
  Reader<TrajectoryCommand> command_reader_;
  Reader<ReadyStatus> ready_reader_;
  std::map<std::uint8_t, Reader<VehicleState>> state_readers_;
  std::unique_ptr<LabEndpoints> lab_endpoints_;
};

}  // namespace hlc
