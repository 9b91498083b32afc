#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/process/command_sender.hpp"
#include "hlc_bridge/process/lab_control_watch.hpp"
#include "hlc_bridge/process/lab_log.hpp"
#include "hlc_bridge/process/step_exchange.hpp"
#include "hlc_bridge/process/subgraph_preparation.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/wait_notice.hpp"
#include "planner/controller/controller.hpp"

namespace hlc {

/// When the waits of a step end in real time, as shares of the time from the list to the step's end
/// (deadline_in_step). In logical time
/// a wait ends when everybody alive has answered.
struct StepDeadlines {
  double traffic{0.20};
  double predecessors{0.55};
  double settle{0.75};
  double command{0.90};     ///< later than this the plan in force stays, and the miss is counted
  double look_ahead{0.50};  ///< later than this policies do not look ahead in this step
};

struct HlcProcessOptions {
  /// For the log. On the domains the process always bears its vehicle's name (messages/node_names),
  /// which the others look for: the lab gives all controllers one node id.
  std::string node_id;
  std::string version{};  ///< ParticipantOptions::version
  Transport transport{Transport::kLab};
  Domains domains;
  std::optional<DiscoveryServer> discovery_server;
  std::vector<std::string>
      controller_peers;  ///< ParticipantOptions::peers of the controllers' domain
  bool logical_time{};
  std::chrono::seconds startup_timeout{30};
  int thread_priority{1};   ///< of the thread that plans (time/precedence); 0: an ordinary one
  std::optional<int> core;  ///< on which it stays
  StepDeadlines deadlines;
  /// Of the scenario's automaton, for new weights (WeightDesign).
  WeightDesign::Source configuration;
  ReconfigurationSettings reconfiguration;  ///< zones and policies
  /// Called with the controller after the command of a step has been sent. What it throws is logged
  /// once, and it is not called again: a run that was good ends with kExitNotWritten.
  std::function<void(const Controller&)> after_step;
};

/// The process of one controller: takes state lists from the middleware, steps the controller,
/// exchanges messages with the other controllers between its phases, answers every list with a
/// command.
///
/// Real time: the start trigger is sent once. A controller that comes later, or again after its
/// death, learns from the others' traffic that the experiment runs, or from the lab control if it
/// is ours. It waits until its vehicle has been seen standing for a horizon, begins with a plan to
/// stand there, and takes part from the next list on. Until then nothing is commanded: the vehicle
/// drives what it was left (HlcCore::may_stand_by).
///
/// Without its middleware it waits for it to be started again, as long as at the start, and plans
/// on then; meanwhile the vehicle drives out what it was sent. In logical time, or when the others
/// drive out their plans too, it leaves at once.
///
/// Without the lab control nobody can stop the cars: the plan in force is driven out. If it is back
/// within kControllerStays (a network cut for longer than the lease), planning goes on; else this
/// one leaves.
///
/// The stop symbol comes by the middleware and, in real time, on the lab domain, too: one that the
/// middleware did not live to carry on must not be forgotten when it is started again. Other
/// triggers count on the local domain alone, as the lab's controllers have them.
///
/// A vehicle follows one controller: where another one of that name is, this one says nothing, and
/// leaves. Ready ones leave as soon as they hear somebody else speak for their vehicle.
///
/// Asked for another subgraph (AutomatonRequest), it prepares it beside the run, switches before
/// the step from which it holds, and answers. In logical time that step waits for what is being
/// prepared. Without being asked it follows its zones and policies (SubgraphChoice); those that
/// look ahead do so after the step's command has been sent.
///
/// All waiting is here and in StepExchange, and every wait ends: at a deadline (real time), when
/// whom it waits for is gone from the domain, or after 10 s of silence (logical time).
class HlcProcess {
 public:
  /// @param controller  of the vehicle that this process drives
  /// @throws std::invalid_argument, std::runtime_error if an endpoint cannot be made
  HlcProcess(HlcProcessOptions options, std::unique_ptr<Controller> controller);

  /// Runs until the stop symbol or `stop`. Exit code: 0 good, 2 it does not fit the others (another
  /// controller of the vehicle, a period that is not its step), 3 somebody did not appear, 4 the
  /// middleware or the lab control died.
  int run();

  /// Ends `run` soon; from any thread. Unlike the stop symbol, after which the vehicle is to hear
  /// nothing, this leaves it its whole plan, which it drives to standstill.
  void stop();

 private:
  enum class Event { kList, kStop, kMiddlewareLost, kLabControlLost, kTwin, kTimeout };

  [[nodiscard]] int drive();
  [[nodiscard]] Event wait_for_event();
  void leave_vehicle_its_plan();
  void take_stop_symbol();
  void tell_losses();
  void watch_lab_control();
  [[nodiscard]] ParticipantOptions on_domain(std::optional<int> domain, DomainRole role);
  [[nodiscard]] bool drives_out() const;
  void check_plan_fits_commands() const;
  void prepare_thread() const;
  void send_ready_now_and_then();
  [[nodiscard]] bool has_everybody() const;
  [[nodiscard]] bool has_lost_middleware() const;
  [[nodiscard]] bool is_middleware_gone_for_good();
  [[nodiscard]] bool has_twin() const;
  [[nodiscard]] bool yields_to_twin() const;
  void tell_whom_it_waits_for();
  void note_who_is_there();
  [[nodiscard]] std::string who_is_missing() const;
  [[nodiscard]] std::set<std::string> peer_names() const;
  [[nodiscard]] bool wait_for_everybody();

  [[nodiscard]] RequestBase request_base() const;
  void note_start(StepIndex step, std::optional<Nanoseconds> trigger);
  void reconfigure(const VehicleStateList& list, StepIndex step);
  void look_ahead(const VehicleStateList& list, const Report& report);
  void tell(const AutomatonAnswer& answer);
  void answer(const VehicleStateList& list);
  [[nodiscard]] ReportRecord run_step(const VehicleStateList& list, const Observation& observation);
  [[nodiscard]] std::vector<VehicleId> present(std::vector<VehicleId> vehicles) const;
  void join_if_others_drive(const Observation& observation);
  void tell_placement();
  void tell_begin(const VehicleStateList& list, std::optional<Nanoseconds> trigger) const;
  void tell_if_stuck(const Report& report);
  void look_back();
  void draw(const Report& report, const VehicleStateList& list);
  /// Sends it and notes in the report if it is not the plan.
  void send_answer(const VehicleStateList& list, Report& report);
  [[nodiscard]] std::vector<VehicleId> others(const Observation& observation) const;

  HlcProcessOptions options_;
  HlcCore core_;
  VehicleId vehicle_;
  std::string middleware_;  ///< its name, if it is one of ours
  Nanoseconds step_ns_;
  std::chrono::steady_clock::time_point started_at_;

  Signal signal_;
  // Guarded by signal_:
  std::deque<VehicleStateList> lists_;
  /// next_start of the trigger; of an experiment that was running before, a time since which it is.
  std::optional<Nanoseconds> start_;
  bool joins_{};  ///< learnt of the start by the others' traffic
  bool stop_{};
  bool stop_symbol_{};               ///< it stops since everybody is to stop
  bool drive_out_{};                 ///< the lab control said so
  std::vector<std::string> losses_;  ///< to be told by this process's own thread (LabLog writes)

  Participant lab_;
  Participant local_;
  Participant controllers_;
  CommandSender commands_;
  Writer<ReadyStatus> ready_writer_;
  Writer<ReportRecord> report_writer_;
  Writer<Visualization> drawing_writer_;
  Writer<StopRequest> stop_request_writer_;
  LabLog lab_log_;
  Writer<AutomatonAnswer> automaton_answer_writer_;
  SubgraphChoice choice_;
  std::optional<StepIndex> first_step_;  ///< of the experiment, once it has begun here
  SubgraphPreparation preparation_;
  Reconfiguration reconfiguration_;

  std::vector<VehicleId> active_;
  LabControlWatch lab_control_;
  std::optional<std::chrono::steady_clock::time_point> middleware_lost_at_;
  WaitNotice wait_notice_;
  std::chrono::steady_clock::time_point last_list_at_;
  WaitNotice list_notice_;  ///< of lists that do not come any more
  bool had_middleware_{};
  bool is_ready_{};
  bool has_bad_period_{};
  std::string last_fault_;           ///< of the last answer: told once, not every step
  std::optional<bool> told_placed_;  ///< whether the vehicle fits, as was told last
  std::string after_step_fault_;     ///< of the one call of `after_step` that failed
  bool told_off_route_{false};
  bool told_budget_{false};
  std::chrono::steady_clock::time_point next_ready_at_{};

  // Readers last: their callbacks use everything above, and they end first.
  StepExchange exchange_;
  Reader<AutomatonRequest> automaton_request_reader_;
  Reader<RunState> run_state_reader_;
  Reader<SystemTrigger> trigger_reader_;
  std::optional<Reader<SystemTrigger>> lab_stop_reader_;  ///< not in logical time
  Reader<VehicleStateList> list_reader_;
};

}  // namespace hlc
