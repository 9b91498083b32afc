#include "hlc_bridge/dds/topics.hpp"

#include <fmt/format.h>

namespace hlc::dds::topics {
namespace {

std::string of_vehicle(std::uint8_t vehicle_id, const char* name) {
  return fmt::format("vehicle/{}/{}", vehicle_id, name);
}

template <class Command>
constexpr const char* kCommandName = nullptr;
template <>
constexpr const char* kCommandName<TrajectoryCommand> = "vehicleCommandTrajectory";
template <>
constexpr const char* kCommandName<PathTrackingCommand> = "vehicleCommandPathTracking";
template <>
constexpr const char* kCommandName<SpeedCurvatureCommand> = "vehicleCommandSpeedCurvature";
template <>
constexpr const char* kCommandName<DirectCommand> = "vehicleCommandDirect";

}  // namespace

Topic<VehicleState> vehicle_state(std::uint8_t vehicle_id) {
  return {TopicId::kVehicleState, of_vehicle(vehicle_id, "vehicleState")};
}

Topic<VehicleObservation> vehicle_observation(std::uint8_t vehicle_id) {
  return {TopicId::kVehicleObservation, of_vehicle(vehicle_id, "vehicleObservation")};
}

template <class Command>
Topic<Command> vehicle_command(std::uint8_t vehicle_id) {
  return {TopicId::kVehicleCommand, of_vehicle(vehicle_id, kCommandName<Command>)};
}
template Topic<TrajectoryCommand> vehicle_command(std::uint8_t vehicle_id);
template Topic<PathTrackingCommand> vehicle_command(std::uint8_t vehicle_id);
template Topic<SpeedCurvatureCommand> vehicle_command(std::uint8_t vehicle_id);
template Topic<DirectCommand> vehicle_command(std::uint8_t vehicle_id);

Topic<VehicleStateList> vehicle_state_list() {
  return {TopicId::kVehicleStateList, "vehicleStateList"};
}

template <class Command>
Topic<Command> command() {
  return {TopicId::kVehicleCommand, kCommandName<Command>};
}
template Topic<TrajectoryCommand> command();
template Topic<PathTrackingCommand> command();
template Topic<SpeedCurvatureCommand> command();
template Topic<DirectCommand> command();

Topic<ReadyStatus> ready_status() { return {TopicId::kReadyStatus, "readyStatus"}; }

Topic<SystemTrigger> system_trigger() { return {TopicId::kSystemTrigger, "systemTrigger"}; }

Topic<Parameter> parameter() { return {TopicId::kParameter, "parameter"}; }

Topic<ParameterRequest> parameter_request() {
  return {TopicId::kParameterRequest, "parameterRequest"};
}

Topic<StopRequest> stop_request() { return {TopicId::kStopRequest, "stopRequest"}; }

Topic<Log> log() { return {TopicId::kLog, "log"}; }

Topic<LogLevel> log_level() { return {TopicId::kLogLevel, "logLevel"}; }

Topic<GoalState> goal_state() { return {TopicId::kGoalState, "commonroad_dds_goal_states"}; }

Topic<Visualization> visualization() { return {TopicId::kVisualization, "visualization"}; }

Topic<coordination::Traffic> traffic() { return {TopicId::kTraffic, "hlc/traffic"}; }

Topic<coordination::Prediction> prediction() { return {TopicId::kPrediction, "hlc/prediction"}; }

Topic<coordination::Outcome> outcome() { return {TopicId::kOutcome, "hlc/outcome"}; }

Topic<ReportRecord> report() { return {TopicId::kReport, "hlc/report"}; }

Topic<RunState> run_state() { return {TopicId::kRunState, "hlc/run_state"}; }

Topic<AutomatonRequest> automaton_request() {
  return {TopicId::kAutomatonRequest, "hlc/automaton_request"};
}

Topic<AutomatonAnswer> automaton_answer() {
  return {TopicId::kAutomatonAnswer, "hlc/automaton_answer"};
}

}  // namespace hlc::dds::topics
