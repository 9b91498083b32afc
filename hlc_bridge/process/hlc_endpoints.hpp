#pragma once

#include <functional>
#include <optional>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/hlc/hlc_machine.hpp"
#include "hlc_bridge/process/shell.hpp"

namespace hlc {

/// The domains that a controller is on.
struct HlcDomains {
  Participant lab;
  Participant local;
  Participant controllers;
};

/// The publications of a controller.
struct HlcWriters {
  /// @param on_presence  called after a change of the matches
  HlcWriters(HlcDomains& domains, const std::function<void()>& on_presence);

  /// Controllers that receive all messages of this one for controllers.
  [[nodiscard]] std::set<std::string> receivers() const;

  Writer<Traffic> traffic;
  Writer<Prediction> prediction;
  Writer<Outcome> outcome;
  Writer<TrajectoryCommand> command;
  Writer<ReportRecord> report;
  Writer<ReadyStatus> ready;
  Writer<Visualization> drawing;
  Writer<StopRequest> stop_request;
  Writer<AutomatonAnswer> automaton_answer;
};

/// The subscriptions of a controller, posted to its shell. Messages that require an answer or an
/// action are urgent; a middleware may forward the trigger of every tick, of which only the stop is
/// urgent.
struct HlcReaders {
  /// @param stops_on_lab  the stop symbol of the lab domain counts, too
  HlcReaders(HlcDomains& domains, Shell<HlcMachine>& shell, bool stops_on_lab);

  Reader<Traffic> traffic;
  Reader<Prediction> prediction;
  Reader<Outcome> outcome;
  Reader<AutomatonRequest> automaton_request;
  Reader<RunState> run_state;
  Reader<SystemTrigger> trigger;
  std::optional<Reader<SystemTrigger>> lab_stop;
  Reader<VehicleStateList> list;
};

}  // namespace hlc
