#include "hlc_bridge/dds/convert_lab.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "hlc_bridge/dds/wire.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::dds::convert_lab_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Message>
class LabConversion : public testing::Test {};
using LabMessages = testing::Types<VehicleState, VehicleObservation, VehicleStateList,
                                   TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand,
                                   DirectCommand, ReadyStatus, SystemTrigger, Parameter,
                                   ParameterRequest, StopRequest, Log, LogLevel, GoalState>;
TYPED_TEST_SUITE(LabConversion, LabMessages);

TYPED_TEST(LabConversion, EveryFieldSurvivesTheWayOverTheWire) {
  const unsigned seed = 1;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  typename Wire<TypeParam>::Type wire;  // used again: nothing of the one before may stay
  for (int i = 0; i < 200; ++i) {
    const auto message = sample<TypeParam>(random);
    to_wire(message, wire);
    const Incoming<TypeParam> back = from_wire(wire);
    ASSERT_TRUE(back.message.has_value());
    ASSERT_EQ(back.invalid, 0U);
    ASSERT_EQ(text(*back.message), text(message));
  }
}

template <class Message>
bool is_refused(const Message& message) {
  typename Wire<Message>::Type wire;
  to_wire(message, wire);
  const Incoming<Message> incoming = from_wire(wire);
  EXPECT_EQ(incoming.invalid, incoming.message ? 0U : 1U);
  return !incoming.message.has_value();
}

TEST(LabConversionRefuses, StatesWithNumbersThatAreNotFinite) {
  for (double VehicleState::*const field :
       {&VehicleState::odometer_distance_m, &VehicleState::imu_acceleration_forward_mps2,
        &VehicleState::imu_acceleration_left_mps2, &VehicleState::imu_acceleration_up_mps2,
        &VehicleState::imu_yaw_rad, &VehicleState::imu_yaw_rate_radps, &VehicleState::speed_mps,
        &VehicleState::battery_voltage_v, &VehicleState::motor_current_a,
        &VehicleState::motor_throttle, &VehicleState::steering_servo}) {
    VehicleState state;
    EXPECT_FALSE(is_refused(state));
    state.*field = kNan;
    EXPECT_TRUE(is_refused(state));
    state.*field = -kInfinity;
    EXPECT_TRUE(is_refused(state));
  }
  for (double Pose::*const field : {&Pose::x_m, &Pose::y_m, &Pose::heading_rad}) {
    VehicleState state;
    state.pose.*field = kNan;
    EXPECT_TRUE(is_refused(state));
    VehicleObservation observation;
    observation.pose.*field = kInfinity;
    EXPECT_TRUE(is_refused(observation));
  }
}

TEST(LabConversionRefuses, CommandsWithNumbersThatAreNotFiniteOrTooManyPoints) {
  for (double TrajectoryPoint::*const field :
       {&TrajectoryPoint::x_m, &TrajectoryPoint::y_m, &TrajectoryPoint::vx_mps,
        &TrajectoryPoint::vy_mps}) {
    TrajectoryCommand command;
    command.points.resize(3);
    EXPECT_FALSE(is_refused(command));
    command.points[2].*field = kNan;
    EXPECT_TRUE(is_refused(command));
  }
  TrajectoryCommand long_one;
  long_one.points.resize(1001);
  EXPECT_TRUE(is_refused(long_one));
  PathTrackingCommand long_path;
  EXPECT_FALSE(is_refused(long_path));
  long_path.path.resize(1001);
  EXPECT_TRUE(is_refused(long_path));

  PathTrackingCommand bent;
  bent.path.resize(3);
  EXPECT_FALSE(is_refused(bent));
  bent.path[1].pose.x_m = kNan;
  EXPECT_TRUE(is_refused(bent));
  bent.path[1] = {.pose = {}, .s_m = kInfinity};
  EXPECT_TRUE(is_refused(bent));
  EXPECT_TRUE(is_refused(PathTrackingCommand{.speed_mps = kNan}));
  EXPECT_TRUE(is_refused(SpeedCurvatureCommand{.speed_mps = kNan}));
  EXPECT_TRUE(is_refused(SpeedCurvatureCommand{.curvature_per_m = kInfinity}));
  EXPECT_TRUE(is_refused(DirectCommand{.motor_throttle = kNan}));
  EXPECT_TRUE(is_refused(DirectCommand{.steering_servo = kNan}));
}

TEST(LabConversionRefuses, ListsWithoutPeriod) {
  const VehicleStateList good{.t_now = 1,
                              .period_ms = 200,
                              .states = {},
                              .observations = {},
                              .active_vehicle_ids = {1, 255}};
  EXPECT_FALSE(is_refused(good));
  VehicleStateList bad = good;
  bad.period_ms = 0;
  EXPECT_TRUE(is_refused(bad));
}

TEST(LabConversion, AStrangeIdInAListIsLeftOutAndTheOthersStay) {
  ::VehicleStateList wire;
  to_wire(VehicleStateList{.t_now = 1,
                           .period_ms = 200,
                           .states = {},
                           .observations = {},
                           .active_vehicle_ids = {0, 1, -1, 256, 255}},
          wire);
  const Incoming<VehicleStateList> incoming = from_wire(wire);
  ASSERT_TRUE(incoming.message.has_value());
  EXPECT_EQ(incoming.message->active_vehicle_ids, (std::vector<std::int32_t>{1, 255}));
  EXPECT_EQ(incoming.invalid, 3U);
}

TEST(LabConversion, AnInvalidStateInAListIsLeftOutAndTheOthersStay) {
  VehicleStateList list{.t_now = 1,
                        .period_ms = 200,
                        .states = std::vector<VehicleState>(3),
                        .observations = std::vector<VehicleObservation>(2),
                        .active_vehicle_ids = {1, 2, 3}};
  list.states[0].vehicle_id = 1;
  list.states[1].vehicle_id = 2;
  list.states[1].speed_mps = kNan;
  list.states[2].vehicle_id = 3;
  list.observations[0].pose.x_m = kNan;
  ::VehicleStateList wire;
  to_wire(list, wire);
  const Incoming<VehicleStateList> incoming = from_wire(wire);
  ASSERT_TRUE(incoming.message.has_value());
  ASSERT_EQ(incoming.message->states.size(), 2U);
  EXPECT_EQ(incoming.message->states[0].vehicle_id, 1);
  EXPECT_EQ(incoming.message->states[1].vehicle_id, 3);
  EXPECT_EQ(incoming.message->observations.size(), 1U);
  EXPECT_EQ(incoming.message->active_vehicle_ids.size(), 3U);
  EXPECT_EQ(incoming.invalid, 2U);
}

TEST(LabConversionRefuses, ParametersOfUnknownTypeOrWithoutTheirValue) {
  ::Parameter wire;
  wire.type(static_cast<::ParameterType>(8));
  EXPECT_FALSE(from_wire(wire).message.has_value());
  wire.type(::ParameterType::Int32);
  EXPECT_FALSE(from_wire(wire).message.has_value());
  wire.values_int32({1, 2});
  EXPECT_FALSE(from_wire(wire).message.has_value());
  wire.values_int32({1});
  EXPECT_TRUE(from_wire(wire).message.has_value());
  wire.type(::ParameterType::Double);
  EXPECT_FALSE(from_wire(wire).message.has_value());
  wire.values_double({kNan});
  EXPECT_FALSE(from_wire(wire).message.has_value());
  wire.values_double({1.0});
  EXPECT_TRUE(from_wire(wire).message.has_value());
}

}  // namespace
}  // namespace hlc::dds::convert_lab_test
