#include "hlc_bridge/dds/topics.hpp"

namespace hlc::topics {
namespace {

std::string of_vehicle(std::uint8_t vehicle_id, const char* name) {
  return "vehicle/" + std::to_string(vehicle_id) + "/" + name;
}

}  // namespace

Topic<VehicleState> vehicle_state(std::uint8_t vehicle_id) {
  return {TopicId::kVehicleState, of_vehicle(vehicle_id, "vehicleState")};
}

Topic<VehicleObservation> vehicle_observation(std::uint8_t vehicle_id) {
  return {TopicId::kVehicleObservation, of_vehicle(vehicle_id, "vehicleObservation")};
}

Topic<TrajectoryCommand> vehicle_command(std::uint8_t vehicle_id) {
  return {TopicId::kTrajectoryCommand, of_vehicle(vehicle_id, "vehicleCommandTrajectory")};
}

Topic<VehicleStateList> vehicle_state_list() {
  return {TopicId::kVehicleStateList, "vehicleStateList"};
}

Topic<TrajectoryCommand> command() {
  return {TopicId::kTrajectoryCommand, "vehicleCommandTrajectory"};
}

Topic<ReadyStatus> ready_status() { return {TopicId::kReadyStatus, "readyStatus"}; }

Topic<SystemTrigger> system_trigger() { return {TopicId::kSystemTrigger, "systemTrigger"}; }

Topic<Parameter> parameter() { return {TopicId::kParameter, "parameter"}; }

Topic<ParameterRequest> parameter_request() {
  return {TopicId::kParameterRequest, "parameterRequest"};
}

Topic<StopRequest> stop_request() { return {TopicId::kStopRequest, "stopRequest"}; }

Topic<Log> log() { return {TopicId::kLog, "log"}; }

Topic<LogLevel> log_level() { return {TopicId::kLogLevel, "logLevel"}; }

Topic<Visualization> visualization() { return {TopicId::kVisualization, "visualization"}; }

Topic<Traffic> traffic() { return {TopicId::kTraffic, "hlc/traffic"}; }

Topic<Prediction> prediction() { return {TopicId::kPrediction, "hlc/prediction"}; }

Topic<Outcome> outcome() { return {TopicId::kOutcome, "hlc/outcome"}; }

Topic<ReportRecord> report() { return {TopicId::kReport, "hlc/report"}; }

Topic<RunState> run_state() { return {TopicId::kRunState, "hlc/run_state"}; }

}  // namespace hlc::topics
