#include "hlc_bridge/dds/register_lab_types.hpp"

#include <ColorTypeObject.h>
#include <CommonroadDDSGoalStateTypeObject.h>
#include <CommonroadDDSShapeTypeObject.h>
#include <CommonroadObstacleListTypeObject.h>
#include <CommonroadObstacleTypeObject.h>
#include <HLCHelloTypeObject.h>
#include <HeaderTypeObject.h>
#include <HlcCommunicationTypeObject.h>
#include <LedPointsTypeObject.h>
#include <LogLevelTypeObject.h>
#include <LogTypeObject.h>
#include <ParameterRequestTypeObject.h>
#include <ParameterTypeObject.h>
#include <Point2DTypeObject.h>
#include <Pose2DTypeObject.h>
#include <ReadyStatusTypeObject.h>
#include <RoundTripTimeTypeObject.h>
#include <StopRequestTypeObject.h>
#include <SystemTriggerTypeObject.h>
#include <TimeStampTypeObject.h>
#include <VehicleCommandDirectTypeObject.h>
#include <VehicleCommandPathTrackingTypeObject.h>
#include <VehicleCommandSpeedCurvatureTypeObject.h>
#include <VehicleCommandTrajectoryTypeObject.h>
#include <VehicleObservationTypeObject.h>
#include <VehicleStateListTypeObject.h>
#include <VehicleStateTypeObject.h>
#include <VisualizationTypeObject.h>

namespace hlc::dds {

void register_lab_types() {
  registerColorTypes();
  registerCommonroadDDSGoalStateTypes();
  registerCommonroadDDSShapeTypes();
  registerCommonroadObstacleTypes();
  registerCommonroadObstacleListTypes();
  registerHLCHelloTypes();
  registerHeaderTypes();
  registerHlcCommunicationTypes();
  registerLedPointsTypes();
  registerLogTypes();
  registerLogLevelTypes();
  registerParameterTypes();
  registerParameterRequestTypes();
  registerPoint2DTypes();
  registerPose2DTypes();
  registerReadyStatusTypes();
  registerRoundTripTimeTypes();
  registerStopRequestTypes();
  registerSystemTriggerTypes();
  registerTimeStampTypes();
  registerVehicleCommandDirectTypes();
  registerVehicleCommandPathTrackingTypes();
  registerVehicleCommandSpeedCurvatureTypes();
  registerVehicleCommandTrajectoryTypes();
  registerVehicleObservationTypes();
  registerVehicleStateTypes();
  registerVehicleStateListTypes();
  registerVisualizationTypes();
}

}  // namespace hlc::dds
