#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/hlc/reconfiguration.hpp"
#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/machine/machine.hpp"
#include "hlc_bridge/messages/automaton_messages.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/coordination/messages.hpp"

/// Events and actions of a controller's machine.
namespace hlc::high_level_controller {

/// The other participants, as far as the controller's endpoints know. The complete state: the last
/// event counts. Names are those of messages/node_names.hpp.
struct HlcPeers {
  machine::Participants lab;
  machine::Participants local;
  machine::Participants controllers;
  /// Participants whose readers are matched with all of this controller's traffic, predictions and
  /// outcomes.
  std::set<std::string> receivers;
  std::size_t command_readers{};
  std::size_t stop_request_readers{};
};

/// An endpoint lost or dropped a message.
struct LostMessage {
  std::string line;  ///< for the log
};

/// AfterStep failed; it is not requested again.
struct AfterStepFailure {
  std::string reason;
};

/// * SystemTrigger: those of the local domain; of the lab domain only the stop symbol.
/// * Parameter: an answer of the lab control (HlcRules::asks_lab_control).
/// * StopSignal: the vehicle keeps its whole plan, unlike after the stop symbol.
using HlcEvent =
    std::variant<HlcPeers, VehicleStateList, SystemTrigger, RunState, coordination::Traffic,
                 coordination::Prediction, coordination::Outcome, AutomatonRequest, PreparedRequest,
                 Parameter, machine::StopSignal, LostMessage, AfterStepFailure>;

/// Prepare this request concurrently (`prepare`); the result is the event PreparedRequest. One at a
/// time.
struct PrepareRequest {
  AutomatonRequest request;
};

/// Draw the step that has just ended on the operator's map.
struct DrawStep {
  coordination::Report report;
  Nanoseconds time_to_live{};
};

/// A step of the experiment has ended, and its command is published: the owner may inspect the
/// controller.
struct AfterStep {};

/// Message types are to be published.
using HlcAction =
    std::variant<coordination::Traffic, coordination::Prediction, coordination::Outcome,
                 TrajectoryCommand, ReportRecord, ReadyStatus, StopRequest, ParameterRequest,
                 AutomatonAnswer, machine::LogLine, PrepareRequest, DrawStep, AfterStep>;

/// Actions in the order of execution.
class HlcActions {
 public:
  void add(HlcAction action) { actions_.push_back(std::move(action)); }
  void info(std::string text) { add(machine::info(std::move(text))); }
  void warn(std::string text) { add(machine::warning(std::move(text))); }
  void error(std::string text) { add(machine::error(std::move(text))); }

  [[nodiscard]] bool empty() const { return actions_.empty(); }
  [[nodiscard]] std::vector<HlcAction> take() { return std::exchange(actions_, {}); }

 private:
  std::vector<HlcAction> actions_;
};

}  // namespace hlc::high_level_controller
