#include "hlc_bridge/hlc/hlc_core.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/hlc/own_command_check.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::high_level_controller::hlc_core_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;

const scenario::Scenario& lab_scenario() {
  static const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_three_cars.yaml",
       .steps = 10});
  return scenario;
}

VehicleStateList list_at(std::uint64_t step) {
  return {.t_now = step * kPeriod + 1, .period_ms = 200, .states = {}, .active_vehicle_ids = {1}};
}

controller::Observation standing_at(StepIndex step, const Pose& pose) {
  return {.step = step,
          .active = {{1}},
          .states = {{.vehicle = {1}, .pose = pose, .speed_mps = 0.0, .age_s = 0.0}},
          .present = {{1}}};
}

Pose start() { return scenario::measured_start(lab_scenario(), lab_scenario().vehicles.front()); }

TEST(HlcCore, SendsThePlanInForceWithPointsAsTheLabAsks) {
  HlcCore core(scenario::make_controller(lab_scenario(), {1}));
  static_cast<void>(core.controller().stand_by(standing_at({10}, start())));
  const AnswerToList answer = core.answer(list_at(10));
  EXPECT_EQ(answer.fault, "");
  ASSERT_THAT(answer.copies, ::testing::SizeIs(1));
  EXPECT_EQ(answer.command.points[1].t - answer.command.points[0].t, 25'000'000U);
  EXPECT_EQ(validate_own_command(answer.command, lab_scenario().lab), "");
}

TEST(HlcCore, AVehicleOutsideTheLabIsToldToStandAndTheReportSaysSo) {
  HlcCore core(scenario::make_controller(lab_scenario(), {1}));
  Pose outside = start();
  outside.x_m = -0.5;
  const coordination::Report standby = core.controller().stand_by(standing_at({10}, outside));
  const AnswerToList answer = core.answer(list_at(10));
  EXPECT_THAT(answer.fault, HasSubstr("coordinate = -0.5 m, must be in 0 ... 4.5 in x"));
  EXPECT_THAT(answer.command.points, IsEmpty());
  EXPECT_EQ(answer.command.create_stamp, list_at(10).t_now);
  EXPECT_THAT(answer.copies, ::testing::IsEmpty());
  const coordination::Report report = with_answer(standby, answer);
  EXPECT_EQ(report.status, coordination::StepStatus::kStandby);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kUndrivable);
}

TEST(HlcCore, WhatFailsIsNotSentButTheLastGoodCommandAgain) {
  HlcCore core(scenario::make_controller(lab_scenario(), {1}));
  static_cast<void>(core.controller().stand_by(standing_at({10}, start())));
  const AnswerToList good = core.answer(list_at(10));
  Pose outside = start();
  outside.y_m = 7.0;
  static_cast<void>(core.controller().stand_by(standing_at({11}, outside)));
  for (std::uint64_t step = 11; step < 14; ++step) {
    const AnswerToList answer = core.answer(list_at(step));
    EXPECT_THAT(answer.fault, HasSubstr("coordinate = 7 m"));
    ASSERT_FALSE(answer.command.points.empty());
    EXPECT_EQ(answer.command.points.front().y_m, good.command.points.front().y_m);
    EXPECT_EQ(validate_own_command(answer.command, lab_scenario().lab), "");
    ASSERT_THAT(answer.copies, ::testing::SizeIs(1));
    EXPECT_EQ(validate_own_command(answer.copies.front(), lab_scenario().lab), "");
    EXPECT_EQ(answer.command.create_stamp, list_at(step).t_now);
  }
}

// A car that had been moved out of the area by hand was commanded for 12 s to stand 1.3 m away.
TEST(HlcCore, WhereTheLastGoodCommandLeadsElsewhereTheVehicleIsLeftAlone) {
  HlcCore core(scenario::make_controller(lab_scenario(), {1}));
  static_cast<void>(core.controller().stand_by(standing_at({10}, start())));
  static_cast<void>(core.answer(list_at(10)));
  Pose outside = start();
  outside.y_m = 7.0;
  static_cast<void>(core.controller().stand_by(standing_at({11}, outside)));
  for (const double beside_m : {0.25, 0.35, 1.3}) {
    VehicleStateList list = list_at(11);
    list.states.push_back(
        {.vehicle_id = 1, .create_stamp = list.t_now, .valid_after_stamp = list.t_now});
    list.states.back().pose = start();
    list.states.back().pose.x_m += beside_m;
    const AnswerToList answer = core.answer(list);
    EXPECT_THAT(answer.fault, HasSubstr("coordinate = 7 m"));
    EXPECT_EQ(answer.command.points.empty(), beside_m > vehicle::kStopBound_m) << beside_m;
    EXPECT_EQ(answer.command.create_stamp, list.t_now);
  }
}

TEST(HlcCore, APlanThatIsNotSentIsAFallbackInTheReport) {
  const coordination::Report planned{.vehicle = {1}, .status = coordination::StepStatus::kPlanned};
  EXPECT_EQ(with_answer(planned, {}).status, coordination::StepStatus::kPlanned);
  const coordination::Report report =
      with_answer(planned, {.fault = "no point before valid_after"});
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kUndrivable);
}

}  // namespace
}  // namespace hlc::high_level_controller::hlc_core_test
