#pragma once

#include <AutomatonAnswerMessage.h>
#include <AutomatonRequestMessage.h>
#include <OutcomeMessage.h>
#include <PredictionMessage.h>
#include <ReportMessage.h>
#include <RunStateMessage.h>
#include <TrafficMessage.h>

#include "hlc_bridge/dds/conversion.hpp"
#include "hlc_bridge/messages/automaton_messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"

/// Our own generated types to and from plain messages. Only sources of this folder (and its tests)
/// include this file.
///
/// from_wire refuses a message with a number that is not finite, an unknown enumeration value, a
/// polygon of one or two vertices, a vehicle id outside 1 ... 30, or more entries than any program
/// sends.
namespace hlc::dds {

/// False if the vehicle id is outside 1 ... 30: the topic has no instance for it.
[[nodiscard]] bool can_be_written(const coordination::Traffic& message);
[[nodiscard]] bool can_be_written(const coordination::Prediction& message);
[[nodiscard]] bool can_be_written(const coordination::Outcome& message);
[[nodiscard]] bool can_be_written(const ReportRecord& message);
[[nodiscard]] bool can_be_written(const AutomatonRequest& message);
[[nodiscard]] bool can_be_written(const AutomatonAnswer& message);

void to_wire(const coordination::Traffic& message, TrafficMessage& wire);
void to_wire(const coordination::Prediction& message, PredictionMessage& wire);
void to_wire(const coordination::Outcome& message, OutcomeMessage& wire);
void to_wire(const ReportRecord& message, ReportMessage& wire);
void to_wire(const RunState& message, RunStateMessage& wire);
void to_wire(const AutomatonRequest& message, AutomatonRequestMessage& wire);
void to_wire(const AutomatonAnswer& message, AutomatonAnswerMessage& wire);

[[nodiscard]] Incoming<coordination::Traffic> from_wire(const TrafficMessage& wire);
[[nodiscard]] Incoming<coordination::Prediction> from_wire(const PredictionMessage& wire);
[[nodiscard]] Incoming<coordination::Outcome> from_wire(const OutcomeMessage& wire);
[[nodiscard]] Incoming<ReportRecord> from_wire(const ReportMessage& wire);
[[nodiscard]] Incoming<RunState> from_wire(const RunStateMessage& wire);
[[nodiscard]] Incoming<AutomatonRequest> from_wire(const AutomatonRequestMessage& wire);
[[nodiscard]] Incoming<AutomatonAnswer> from_wire(const AutomatonAnswerMessage& wire);

}  // namespace hlc::dds
