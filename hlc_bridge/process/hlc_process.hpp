#pragma once

#include <chrono>
#include <filesystem>
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

namespace hlc::process {

struct HlcProcessOptions {
  /// For the log. On the domains the process always has its vehicle's name (messages/node_names),
  /// which the others expect: the lab gives all controllers one node id.
  std::string node_id;
  std::string version{};  ///< ParticipantOptions::version
  std::function<void(const dds::PublishedMessage&)> on_published{};  ///< ParticipantOptions
  dds::Transport transport{dds::Transport::kLab};
  dds::Domains domains;
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};  ///< ParticipantOptions
  /// ParticipantOptions::peers of the controllers' domain
  std::vector<std::string> controller_peers;
  machine::RunTime time{machine::kRealTime};
  high_level_controller::HlcRules rules;
  std::chrono::seconds startup_timeout{30};
  int thread_priority{1};   ///< of the planning thread (time/precedence); 0: an ordinary one
  std::optional<int> core;  ///< processor core of the planning thread
  /// Of the scenario's automaton, for new weights (WeightDesign).
  high_level_controller::WeightDesign::Source configuration;
  policy::ReconfigurationSettings reconfiguration;  ///< zones and policies
  /// Called with the controller after the command of a step has been sent. Its first exception is
  /// logged, and it is not called again: a successful run then ends with kExitNotWritten.
  std::function<void(const controller::Controller&)> after_step;
};

/// The process of one controller: an HlcMachine (hlc_bridge/hlc) on the shell, with its endpoints
/// on the lab's, the local and the controllers' domain.
///
/// Real time: the start trigger is sent once. A controller that starts later, or restarts, detects
/// the running experiment from the others' traffic, or from the lab control if it is ours. It waits
/// until its vehicle has stood for a horizon, begins with a plan to stand there, and takes part
/// from the next list on. Until then it sends no command: the vehicle drives the plan that it has
/// (HlcCore::may_stand_by).
///
/// Logical time: the same, except that every list is answered, with a command that has no effect,
/// since the middleware waits for the answers; and that a vehicle that is seen from the begin of
/// time on has no former plan.
///
/// Without its middleware it waits for a restart of the middleware, with the same timeout as at the
/// start, and plans on then; meanwhile the vehicle makes a minimal-risk stop. In logical time, or
/// when the others make a minimal-risk stop, too, it leaves at once.
///
/// Without the lab control the cars cannot be stopped: the vehicle makes a minimal-risk stop. If
/// the lab control is back within kControllerStays (a network cut for longer than the lease),
/// planning continues; otherwise the process leaves.
///
/// The stop symbol comes by the middleware and, in real time, on the lab domain, too: a stop during
/// an outage of the middleware must not be lost. Other triggers count on the local domain alone, as
/// for the lab's controllers.
///
/// A vehicle follows one controller: a duplicate instance publishes nothing, and leaves. Ready
/// controllers leave as soon as they receive messages of another one for their vehicle (Readiness).
///
/// A requested subgraph (AutomatonRequest) is prepared in the background; the controller switches
/// before the first step of its validity, and answers. In logical time that step waits for the
/// preparation. Without a request it follows its zones and policies (SubgraphSelector); those that
/// look ahead do so after the step's command has been sent.
class HlcProcess {
 public:
  /// @param controller  of the vehicle that this process drives
  /// @throws std::invalid_argument, std::runtime_error if an endpoint cannot be made
  HlcProcess(HlcProcessOptions options, std::unique_ptr<controller::Controller> controller);

  /// Runs until the stop symbol or `stop`. Exit code: 0 success, 1 success, but `after_step`
  /// failed, 2 it does not fit the others (another controller of the vehicle, a period that is not
  /// its step), 3 startup timeout, 4 the middleware or the lab control died.
  int run();

  /// Ends `run` soon; from any thread. Unlike after the stop symbol, the vehicle keeps its whole
  /// plan, which it drives to standstill.
  void stop() { shell_.stop(); }

 private:
  friend class machine::Loop<high_level_controller::HlcMachine>;

  [[nodiscard]] dds::ParticipantOptions on_domain(std::optional<int> domain, dds::DomainRole role);
  void prepare_thread() const;

  [[nodiscard]] high_level_controller::HlcPeers presence() const;
  void perform(const coordination::Traffic& message) { writers_.traffic.write(message); }
  void perform(const coordination::Prediction& message) { writers_.prediction.write(message); }
  void perform(const coordination::Outcome& message) { writers_.outcome.write(message); }
  void perform(const TrajectoryCommand& message) { writers_.command.write(message); }
  void perform(const ReportRecord& message) { writers_.report.write(message); }
  void perform(const ReadyStatus& message) { writers_.ready.write(message); }
  void perform(const StopRequest& message) { writers_.stop_request.write(message); }
  void perform(const ParameterRequest& message) { writers_.parameter_request->write(message); }
  void perform(const AutomatonAnswer& message) { writers_.automaton_answer.write(message); }
  void perform(const machine::LogLine& line) { log(options_.node_id, line); }
  void perform(const high_level_controller::PrepareRequest& action) {
    preparation_.ask(action.request);
  }
  void perform(const high_level_controller::DrawStep& action);
  void perform(const high_level_controller::AfterStep& action);

  HlcProcessOptions options_;
  Shell<high_level_controller::HlcMachine> shell_;
  VehicleId vehicle_;

  HlcDomains domains_;
  HlcWriters writers_;
  LabLog lab_log_;
  SubgraphPreparation preparation_;

  HlcReaders readers_;  // last: their callbacks use the shell, and they end first
};

}  // namespace hlc::process
