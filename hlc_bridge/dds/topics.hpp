#pragma once

#include <cstdint>
#include <string>

#include "hlc_bridge/messages/automaton_messages.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::dds {

/// The row of the table of quality of service (endpoint_qos.hpp) for a topic.
enum class TopicId : std::uint8_t {
  kVehicleState,
  kVehicleObservation,
  kVehicleStateList,
  kVehicleCommand,  ///< whichever of the four
  kReadyStatus,
  kSystemTrigger,
  kParameter,
  kParameterRequest,
  kStopRequest,
  kLog,
  kLogLevel,
  kVisualization,
  kGoalState,
  kTraffic,
  kPrediction,
  kOutcome,
  kReport,
  kRunState,
  kAutomatonRequest,
  kAutomatonAnswer,
};

/// A topic and its message type: writers and readers of another type do not compile.
template <class Message>
struct Topic {
  TopicId id;
  std::string name;
};

namespace topics {

// `Command` below: TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand or DirectCommand.

// Lab domain, one topic per vehicle: vehicle/<id>/...
[[nodiscard]] Topic<VehicleState> vehicle_state(std::uint8_t vehicle_id);
[[nodiscard]] Topic<VehicleObservation> vehicle_observation(std::uint8_t vehicle_id);
template <class Command = TrajectoryCommand>
[[nodiscard]] Topic<Command> vehicle_command(std::uint8_t vehicle_id);

// Local domain
[[nodiscard]] Topic<VehicleStateList> vehicle_state_list();
template <class Command = TrajectoryCommand>
[[nodiscard]] Topic<Command> command();

// Lab and local domain
[[nodiscard]] Topic<ReadyStatus> ready_status();
[[nodiscard]] Topic<SystemTrigger> system_trigger();
[[nodiscard]] Topic<GoalState> goal_state();  ///< late joiners get all

// Lab domain
[[nodiscard]] Topic<Parameter> parameter();
[[nodiscard]] Topic<ParameterRequest> parameter_request();
[[nodiscard]] Topic<StopRequest> stop_request();
[[nodiscard]] Topic<Log> log();
[[nodiscard]] Topic<LogLevel> log_level();
[[nodiscard]] Topic<Visualization> visualization();

// Controller domain; all but run_state keyed by the vehicle
[[nodiscard]] Topic<coordination::Traffic> traffic();
[[nodiscard]] Topic<coordination::Prediction> prediction();
[[nodiscard]] Topic<coordination::Outcome> outcome();
[[nodiscard]] Topic<ReportRecord> report();  ///< late joiners get all reports of a run
[[nodiscard]] Topic<RunState> run_state();   ///< late joiners get the last one
[[nodiscard]] Topic<AutomatonRequest> automaton_request();  ///< late joiners get the last one
[[nodiscard]] Topic<AutomatonAnswer> automaton_answer();    ///< late joiners get the last ones

}  // namespace topics
}  // namespace hlc::dds
