#pragma once

#include <AutomatonAnswerMessagePubSubTypes.h>
#include <AutomatonRequestMessagePubSubTypes.h>
#include <CommonroadDDSGoalStatePubSubTypes.h>
#include <LogLevelPubSubTypes.h>
#include <LogPubSubTypes.h>
#include <OutcomeMessagePubSubTypes.h>
#include <ParameterPubSubTypes.h>
#include <ParameterRequestPubSubTypes.h>
#include <PredictionMessagePubSubTypes.h>
#include <ReadyStatusPubSubTypes.h>
#include <ReportMessagePubSubTypes.h>
#include <RunStateMessagePubSubTypes.h>
#include <StopRequestPubSubTypes.h>
#include <SystemTriggerPubSubTypes.h>
#include <TrafficMessagePubSubTypes.h>
#include <VehicleCommandDirectPubSubTypes.h>
#include <VehicleCommandPathTrackingPubSubTypes.h>
#include <VehicleCommandSpeedCurvaturePubSubTypes.h>
#include <VehicleCommandTrajectoryPubSubTypes.h>
#include <VehicleObservationPubSubTypes.h>
#include <VehicleStateListPubSubTypes.h>
#include <VehicleStatePubSubTypes.h>
#include <VisualizationPubSubTypes.h>

#include "hlc_bridge/dds/convert_hlc.hpp"
#include "hlc_bridge/dds/convert_lab.hpp"
#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/transport.hpp"

/// The generated type of each plain message. Only sources of this folder (and its tests) include
/// this file.
namespace hlc::dds {

template <class Message>
struct Wire;

/// A lab type: announces its type object, as the lab's processes do.
template <class GeneratedType, class GeneratedPubSubType>
struct LabWire {
  using Type = GeneratedType;
  using PubSubType = GeneratedPubSubType;
  static constexpr bool kAnnouncesTypeObject = true;
};

/// Our own: never announces one.
template <class GeneratedType, class GeneratedPubSubType>
struct OwnWire {
  using Type = GeneratedType;
  using PubSubType = GeneratedPubSubType;
  static constexpr bool kAnnouncesTypeObject = false;
};

// clang-format off
template <> struct Wire<VehicleState> : LabWire<::VehicleState, VehicleStatePubSubType> {};
template <> struct Wire<VehicleObservation> : LabWire<::VehicleObservation, VehicleObservationPubSubType> {};
template <> struct Wire<VehicleStateList> : LabWire<::VehicleStateList, VehicleStateListPubSubType> {};
template <> struct Wire<TrajectoryCommand> : LabWire<::VehicleCommandTrajectory, VehicleCommandTrajectoryPubSubType> {};
template <> struct Wire<PathTrackingCommand> : LabWire<::VehicleCommandPathTracking, VehicleCommandPathTrackingPubSubType> {};
template <> struct Wire<SpeedCurvatureCommand> : LabWire<::VehicleCommandSpeedCurvature, VehicleCommandSpeedCurvaturePubSubType> {};
template <> struct Wire<DirectCommand> : LabWire<::VehicleCommandDirect, VehicleCommandDirectPubSubType> {};
template <> struct Wire<ReadyStatus> : LabWire<::ReadyStatus, ReadyStatusPubSubType> {};
template <> struct Wire<SystemTrigger> : LabWire<::SystemTrigger, SystemTriggerPubSubType> {};
template <> struct Wire<Parameter> : LabWire<::Parameter, ParameterPubSubType> {};
template <> struct Wire<ParameterRequest> : LabWire<::ParameterRequest, ParameterRequestPubSubType> {};
template <> struct Wire<StopRequest> : LabWire<::StopRequest, StopRequestPubSubType> {};
template <> struct Wire<Log> : LabWire<::Log, LogPubSubType> {};
template <> struct Wire<LogLevel> : LabWire<::LogLevel, LogLevelPubSubType> {};
template <> struct Wire<GoalState> : LabWire<::CommonroadDDSGoalState, CommonroadDDSGoalStatePubSubType> {};
template <> struct Wire<Visualization> : LabWire<::Visualization, VisualizationPubSubType> {};
template <> struct Wire<coordination::Traffic> : OwnWire<TrafficMessage, TrafficMessagePubSubType> {};
template <> struct Wire<coordination::Prediction> : OwnWire<PredictionMessage, PredictionMessagePubSubType> {};
template <> struct Wire<coordination::Outcome> : OwnWire<OutcomeMessage, OutcomeMessagePubSubType> {};
template <> struct Wire<ReportRecord> : OwnWire<ReportMessage, ReportMessagePubSubType> {};
template <> struct Wire<AutomatonRequest> : OwnWire<AutomatonRequestMessage, AutomatonRequestMessagePubSubType> {};
template <> struct Wire<AutomatonAnswer> : OwnWire<AutomatonAnswerMessage, AutomatonAnswerMessagePubSubType> {};
template <> struct Wire<RunState> : OwnWire<RunStateMessage, RunStateMessagePubSubType> {};
// clang-format on

/// Type objects are announced to the lab's processes only: discovery costs several times as much
/// with them.
template <class Message>
[[nodiscard]] fdds::TypeSupport type_support(Transport transport) {
  const bool announces = transport == Transport::kLab && Wire<Message>::kAnnouncesTypeObject;
  return fdds::TypeSupport{new TolerantType<typename Wire<Message>::PubSubType>{announces}};
}

}  // namespace hlc::dds
