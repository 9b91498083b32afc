#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "hlc_bridge/messages/automaton_messages.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/coordination/messages.hpp"

/// Messages to send in tests, every field with a value of its own, and their text, which names
/// every field: two messages are equal if and only if their texts are.
namespace hlc::dds {

/// Every message that has a type on the wire.
using AllMessages =
    testing::Types<VehicleState, VehicleObservation, VehicleStateList, TrajectoryCommand,
                   PathTrackingCommand, SpeedCurvatureCommand, DirectCommand, ReadyStatus,
                   SystemTrigger, Parameter, ParameterRequest, StopRequest, Log, LogLevel,
                   Visualization, GoalState, coordination::Traffic, coordination::Prediction,
                   coordination::Outcome, ReportRecord, RunState, AutomatonRequest,
                   AutomatonAnswer>;

/// A valid message of random content.
template <class Message>
[[nodiscard]] Message sample(std::mt19937_64& random);

[[nodiscard]] std::string text(const VehicleState& message);
[[nodiscard]] std::string text(const VehicleObservation& message);
[[nodiscard]] std::string text(const VehicleStateList& message);
[[nodiscard]] std::string text(const TrajectoryCommand& message);
[[nodiscard]] std::string text(const PathTrackingCommand& message);
[[nodiscard]] std::string text(const SpeedCurvatureCommand& message);
[[nodiscard]] std::string text(const DirectCommand& message);
[[nodiscard]] std::string text(const ReadyStatus& message);
[[nodiscard]] std::string text(const SystemTrigger& message);
[[nodiscard]] std::string text(const Parameter& message);
[[nodiscard]] std::string text(const ParameterRequest& message);
[[nodiscard]] std::string text(const StopRequest& message);
[[nodiscard]] std::string text(const Log& message);
[[nodiscard]] std::string text(const LogLevel& message);
[[nodiscard]] std::string text(const Visualization& message);
[[nodiscard]] std::string text(const GoalState& message);
[[nodiscard]] std::string text(const coordination::Traffic& message);
[[nodiscard]] std::string text(const coordination::Prediction& message);
[[nodiscard]] std::string text(const coordination::Outcome& message);
[[nodiscard]] std::string text(const ReportRecord& message);
[[nodiscard]] std::string text(const RunState& message);
[[nodiscard]] std::string text(const AutomatonRequest& message);
[[nodiscard]] std::string text(const AutomatonAnswer& message);

}  // namespace hlc::dds
