#include "hlc_bridge/dds/topics.hpp"

#include <gtest/gtest.h>

namespace hlc::dds::topics_test {
namespace {

TEST(Topics, HaveTheLabsNames) {
  EXPECT_EQ(topics::vehicle_state(7).name, "vehicle/7/vehicleState");
  EXPECT_EQ(topics::vehicle_observation(30).name, "vehicle/30/vehicleObservation");
  EXPECT_EQ(topics::vehicle_command(1).name, "vehicle/1/vehicleCommandTrajectory");
  EXPECT_EQ(topics::vehicle_state_list().name, "vehicleStateList");
  EXPECT_EQ(topics::command().name, "vehicleCommandTrajectory");
  EXPECT_EQ(topics::ready_status().name, "readyStatus");
  EXPECT_EQ(topics::system_trigger().name, "systemTrigger");
  EXPECT_EQ(topics::parameter().name, "parameter");
  EXPECT_EQ(topics::parameter_request().name, "parameterRequest");
  EXPECT_EQ(topics::stop_request().name, "stopRequest");
  EXPECT_EQ(topics::log().name, "log");
  EXPECT_EQ(topics::log_level().name, "logLevel");
  EXPECT_EQ(topics::goal_state().name, "commonroad_dds_goal_states");
}

}  // namespace
}  // namespace hlc::dds::topics_test
