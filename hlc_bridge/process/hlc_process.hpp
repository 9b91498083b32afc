#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/hlc/hlc_machine.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/process/hlc_endpoints.hpp"
#include "hlc_bridge/process/lab_log.hpp"
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/process/shell.hpp"
#include "hlc_bridge/process/subgraph_preparation.hpp"

namespace hlc {

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
  RunTime time{kRealTime};
  HlcRules rules;
  std::chrono::seconds startup_timeout{30};
  int thread_priority{1};   ///< of the thread that plans (time/precedence); 0: an ordinary one
  std::optional<int> core;  ///< on which it stays
  /// Of the scenario's automaton, for new weights (WeightDesign).
  WeightDesign::Source configuration;
  ReconfigurationSettings reconfiguration;  ///< zones and policies
  /// Called with the controller after the command of a step has been sent. What it throws is logged
  /// once, and it is not called again: a run that was good ends with kExitNotWritten.
  std::function<void(const Controller&)> after_step;
};

/// The process of one controller: an HlcMachine (hlc_bridge/hlc) on the shell, with its endpoints
/// on the lab's, the local and the controllers' domain.
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
/// middleware did not live to forward must not be forgotten when it is started again. Other
/// triggers count on the local domain alone, as the lab's controllers have them.
///
/// A vehicle follows one controller: a duplicate instance publishes nothing, and leaves. Ready ones
/// leave as soon as they receive what another one publishes for their vehicle (Readiness).
///
/// Asked for another subgraph (AutomatonRequest), it prepares it beside the run, switches before
/// the step from which it holds, and answers. In logical time that step waits for what is being
/// prepared. Without being asked it follows its zones and policies (SubgraphSelector); those that
/// look ahead do so after the step's command has been sent.
class HlcProcess {
 public:
  /// @param controller  of the vehicle that this process drives
  /// @throws std::invalid_argument, std::runtime_error if an endpoint cannot be made
  HlcProcess(HlcProcessOptions options, std::unique_ptr<Controller> controller);

  /// Runs until the stop symbol or `stop`. Exit code: 0 good, 1 good but `after_step` failed, 2 it
  /// does not fit the others (another controller of the vehicle, a period that is not its step), 3
  /// somebody did not appear, 4 the middleware or the lab control died.
  int run();

  /// Ends `run` soon; from any thread. Unlike the stop symbol, after which the vehicle is to hear
  /// nothing, this leaves it its whole plan, which it drives to standstill.
  void stop() { shell_.stop(); }

 private:
  friend class Shell<HlcMachine>;

  [[nodiscard]] ParticipantOptions on_domain(std::optional<int> domain, DomainRole role);
  void prepare_thread() const;

  [[nodiscard]] HlcPeers presence() const;
  void perform(const Traffic& message) { writers_.traffic.write(message); }
  void perform(const Prediction& message) { writers_.prediction.write(message); }
  void perform(const Outcome& message) { writers_.outcome.write(message); }
  void perform(const TrajectoryCommand& message) { writers_.command.write(message); }
  void perform(const ReportRecord& message) { writers_.report.write(message); }
  void perform(const ReadyStatus& message) { writers_.ready.write(message); }
  void perform(const StopRequest& message) { writers_.stop_request.write(message); }
  void perform(const AutomatonAnswer& message) { writers_.automaton_answer.write(message); }
  void perform(const machine::LogLine& line) { log(options_.node_id, line); }
  void perform(const PrepareRequest& action) { preparation_.ask(action.request); }
  void perform(const DrawStep& action);
  void perform(const AfterStep& action);

  HlcProcessOptions options_;
  Shell<HlcMachine> shell_;
  VehicleId vehicle_;

  HlcDomains domains_;
  HlcWriters writers_;
  LabLog lab_log_;
  SubgraphPreparation preparation_;

  HlcReaders readers_;  // last: their callbacks use the shell, and they end first
};

}  // namespace hlc
