#pragma once

#include <functional>
#include <optional>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/hlc/hlc_machine.hpp"
#include "hlc_bridge/process/shell.hpp"

namespace hlc::process {

/// The domains that a controller is on.
struct HlcDomains {
  dds::Participant lab;
  dds::Participant local;
  dds::Participant controllers;
};

/// The publications of a controller.
struct HlcWriters {
  /// @param on_presence       called after a change of the matches
  /// @param asks_lab_control  for parameters
  HlcWriters(HlcDomains& domains, const std::function<void()>& on_presence, bool asks_lab_control);

  /// Controllers that receive all messages of this one for controllers.
  [[nodiscard]] std::set<std::string> receivers() const;

  dds::Writer<coordination::Traffic> traffic;
  dds::Writer<coordination::Prediction> prediction;
  dds::Writer<coordination::Outcome> outcome;
  dds::Writer<TrajectoryCommand> command;
  dds::Writer<ReportRecord> report;
  dds::Writer<ReadyStatus> ready;
  dds::Writer<Visualization> drawing;
  dds::Writer<StopRequest> stop_request;
  dds::Writer<AutomatonAnswer> automaton_answer;
  std::optional<dds::Writer<ParameterRequest>> parameter_request;
};

/// The subscriptions of a controller, posted to its shell. Messages that require an answer or an
/// action are urgent; a middleware may forward the trigger of every tick, of which only the stop is
/// urgent.
struct HlcReaders {
  /// @param rules  stops_on_lab_domain, asks_lab_control: what is read on the lab domain
  HlcReaders(HlcDomains& domains, Shell<high_level_controller::HlcMachine>& shell,
             const high_level_controller::HlcRules& rules, VehicleId vehicle);

  dds::Reader<coordination::Traffic> traffic;
  dds::Reader<coordination::Prediction> prediction;
  dds::Reader<coordination::Outcome> outcome;
  dds::Reader<AutomatonRequest> automaton_request;
  dds::Reader<RunState> run_state;
  dds::Reader<SystemTrigger> trigger;
  std::optional<dds::Reader<SystemTrigger>> lab_stop;
  std::optional<dds::Reader<Parameter>> parameter;
  dds::Reader<VehicleStateList> list;
};

}  // namespace hlc::process
