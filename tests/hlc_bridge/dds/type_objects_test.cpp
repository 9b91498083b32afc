#include <gtest/gtest.h>

#include <string>

#include "hlc_bridge/dds/register_lab_types.hpp"
#include "hlc_bridge/dds/wire.hpp"

namespace hlc::dds::type_objects_test {
namespace {

TEST(LabTypes, AllAreRegistered) {
  if (kLibraryMajor > 2) GTEST_SKIP() << "Fast DDS 3 needs no registration";
  register_lab_types();
  for (const char* name : {"Color",
                           "CommonroadDDSGoalState",
                           "CommonroadDDSShape",
                           "CommonroadObstacle",
                           "CommonroadObstacleList",
                           "HLCHello",
                           "Header",
                           "HlcCommunication",
                           "LedPoints",
                           "Log",
                           "LogLevel",
                           "Parameter",
                           "ParameterRequest",
                           "Point2D",
                           "Pose2D",
                           "ReadyStatus",
                           "RoundTripTime",
                           "StopRequest",
                           "SystemTrigger",
                           "TimeStamp",
                           "VehicleCommandDirect",
                           "VehicleCommandPathTracking",
                           "VehicleCommandSpeedCurvature",
                           "VehicleCommandTrajectory",
                           "VehicleObservation",
                           "VehicleState",
                           "VehicleStateList",
                           "Visualization"}) {
    EXPECT_TRUE(knows_type_object(name)) << name;
  }
}

template <class Message>
void expect_lab_type(const std::string& name) {
  const auto type = type_support<Message>(Transport::kLab);
  EXPECT_EQ(type.get_type_name(), name);
  EXPECT_FALSE(has_key(type)) << name << " has a key";
  EXPECT_TRUE(announces_type_object(type)) << name;
}

TEST(LabTypes, HaveBareNamesNoKeysAndAnnounceTypeObjects) {
  expect_lab_type<VehicleState>("VehicleState");
  expect_lab_type<VehicleObservation>("VehicleObservation");
  expect_lab_type<VehicleStateList>("VehicleStateList");
  expect_lab_type<TrajectoryCommand>("VehicleCommandTrajectory");
  expect_lab_type<ReadyStatus>("ReadyStatus");
  expect_lab_type<SystemTrigger>("SystemTrigger");
  expect_lab_type<Parameter>("Parameter");
  expect_lab_type<ParameterRequest>("ParameterRequest");
  expect_lab_type<StopRequest>("StopRequest");
  expect_lab_type<Log>("Log");
  expect_lab_type<LogLevel>("LogLevel");
  expect_lab_type<Visualization>("Visualization");
}

TEST(LabTypes, AnnounceNoTypeObjectsAmongOurOwnProcesses) {
  const auto type = type_support<VehicleStateList>(Transport::kLoopback);
  EXPECT_TRUE(announces_no_type_object(type));
}

template <class Message>
void expect_own_type(const std::string& name, bool keyed) {
  const auto type = type_support<Message>(Transport::kLab);
  EXPECT_EQ(type.get_type_name(), name);
  EXPECT_EQ(has_key(type), keyed) << name;
  EXPECT_TRUE(announces_no_type_object(type)) << name;
  EXPECT_FALSE(knows_type_object(name)) << name;
}

TEST(OwnTypes, AreKeyedByTheVehicleAndNeverAnnounceTypeObjects) {
  expect_own_type<coordination::Traffic>("hlc::TrafficMessage", true);
  expect_own_type<coordination::Prediction>("hlc::PredictionMessage", true);
  expect_own_type<coordination::Outcome>("hlc::OutcomeMessage", true);
  expect_own_type<ReportRecord>("hlc::ReportMessage", true);
  expect_own_type<AutomatonRequest>("hlc::AutomatonRequestMessage", true);
  expect_own_type<AutomatonAnswer>("hlc::AutomatonAnswerMessage", true);
  expect_own_type<RunState>("hlc::RunStateMessage", false);
}

// Body sizes that were measured on the lab's wire (4 bytes of encapsulation come on top).
template <class Message>
std::uint32_t body_bytes(const Message& message) {
  typename Wire<Message>::Type wire;
  to_wire(message, wire);
  return serialized_size(*type_support<Message>(Transport::kLab), &wire) - 4;
}

TEST(LabTypes, HaveTheSizesOfTheLabsMessages) {
  EXPECT_EQ(body_bytes(VehicleState{}), 145U);
  EXPECT_EQ(body_bytes(VehicleObservation{}), 48U);
  EXPECT_EQ(body_bytes(SystemTrigger{}), 8U);
  TrajectoryCommand command;
  command.points.resize(18);
  EXPECT_EQ(body_bytes(command), 752U);
  VehicleStateList list;
  list.states.resize(1);
  list.observations.resize(1);
  list.active_vehicle_ids = {1};
  EXPECT_EQ(body_bytes(list), 224U);
}

}  // namespace
}  // namespace hlc::dds::type_objects_test
