#pragma once

#include <CommonroadDDSGoalState.h>
#include <Log.h>
#include <LogLevel.h>
#include <Parameter.h>
#include <ParameterRequest.h>
#include <ReadyStatus.h>
#include <StopRequest.h>
#include <SystemTrigger.h>
#include <VehicleCommandDirect.h>
#include <VehicleCommandPathTracking.h>
#include <VehicleCommandSpeedCurvature.h>
#include <VehicleCommandTrajectory.h>
#include <VehicleObservation.h>
#include <VehicleState.h>
#include <VehicleStateList.h>
#include <Visualization.h>

#include "hlc_bridge/dds/conversion.hpp"
#include "hlc_bridge/messages/messages.hpp"

/// The lab's generated types to and from plain messages. Only sources of this folder (and its
/// tests) include this file.
///
/// from_wire refuses a message with a number that is not finite, an unknown enumeration value, more
/// entries than any program sends, or a state list with a period of 0. One vehicle's invalid state
/// or observation in a list, or an active id outside 1 ... 255, does not make the list invalid: it
/// is left out, and the others are passed on. A goal is forwarded as it is: it has fields that are
/// not set.
namespace hlc::dds {

void to_wire(const VehicleState& message, ::VehicleState& wire);
void to_wire(const VehicleObservation& message, ::VehicleObservation& wire);
void to_wire(const VehicleStateList& message, ::VehicleStateList& wire);
void to_wire(const TrajectoryCommand& message, ::VehicleCommandTrajectory& wire);
void to_wire(const PathTrackingCommand& message, ::VehicleCommandPathTracking& wire);
void to_wire(const SpeedCurvatureCommand& message, ::VehicleCommandSpeedCurvature& wire);
void to_wire(const DirectCommand& message, ::VehicleCommandDirect& wire);
void to_wire(const ReadyStatus& message, ::ReadyStatus& wire);
void to_wire(const SystemTrigger& message, ::SystemTrigger& wire);
void to_wire(const Parameter& message, ::Parameter& wire);
void to_wire(const ParameterRequest& message, ::ParameterRequest& wire);
void to_wire(const StopRequest& message, ::StopRequest& wire);
void to_wire(const Log& message, ::Log& wire);
void to_wire(const LogLevel& message, ::LogLevel& wire);
void to_wire(const GoalState& message, ::CommonroadDDSGoalState& wire);
void to_wire(const Visualization& message, ::Visualization& wire);

[[nodiscard]] Incoming<VehicleState> from_wire(const ::VehicleState& wire);
[[nodiscard]] Incoming<VehicleObservation> from_wire(const ::VehicleObservation& wire);
[[nodiscard]] Incoming<VehicleStateList> from_wire(const ::VehicleStateList& wire);
[[nodiscard]] Incoming<TrajectoryCommand> from_wire(const ::VehicleCommandTrajectory& wire);
[[nodiscard]] Incoming<PathTrackingCommand> from_wire(const ::VehicleCommandPathTracking& wire);
[[nodiscard]] Incoming<SpeedCurvatureCommand> from_wire(const ::VehicleCommandSpeedCurvature& wire);
[[nodiscard]] Incoming<DirectCommand> from_wire(const ::VehicleCommandDirect& wire);
[[nodiscard]] Incoming<ReadyStatus> from_wire(const ::ReadyStatus& wire);
[[nodiscard]] Incoming<SystemTrigger> from_wire(const ::SystemTrigger& wire);
[[nodiscard]] Incoming<Parameter> from_wire(const ::Parameter& wire);
[[nodiscard]] Incoming<ParameterRequest> from_wire(const ::ParameterRequest& wire);
[[nodiscard]] Incoming<StopRequest> from_wire(const ::StopRequest& wire);
[[nodiscard]] Incoming<Log> from_wire(const ::Log& wire);
[[nodiscard]] Incoming<LogLevel> from_wire(const ::LogLevel& wire);
[[nodiscard]] Incoming<GoalState> from_wire(const ::CommonroadDDSGoalState& wire);
[[nodiscard]] Incoming<Visualization> from_wire(const ::Visualization& wire);

}  // namespace hlc::dds
