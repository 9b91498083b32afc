#include "vehicle_sim/closed_loop/invariants.hpp"

#include <gtest/gtest.h>

#include "planner/coordination/certificate.hpp"

namespace hlc::closed_loop {
namespace {

constexpr VehicleId kOne{1};
constexpr VehicleId kTwo{2};

ConvexPolygon square_at(double x_m) {
  return footprint_area({.length_m = 0.2, .width_m = 0.2}, {.x_m = x_m});
}

coordination::Prediction standing_at(VehicleId vehicle, std::uint64_t step, double x_m) {
  return {.vehicle = vehicle,
          .step = {step},
          .is_new = true,
          .areas = {.first = {step + 1}, .areas_m = {}, .final_area_m = square_at(x_m)}};
}

coordination::Report report_of(
    VehicleId vehicle, std::uint64_t step, coordination::StepStatus status,
    coordination::FallbackReason reason = coordination::FallbackReason::kNone) {
  return {.vehicle = vehicle, .step = {step}, .status = status, .reason = reason};
}

class Footprints : public testing::Test {
 protected:
  FootprintsCheck check_{{.length_m = 0.2, .width_m = 0.1},
                         {{std::uint8_t{1}, Pose{}}, {std::uint8_t{2}, Pose{.x_m = 1.0}}}};
  Violations violations_;
};

TEST_F(Footprints, AreComparedAtTheSameTickHoweverLateItIsTold) {
  check_.driven(2, 99, {.x_m = 1.0});
  check_.driven(1, 99, {.x_m = 0.0});
  check_.driven(1, 100, {.x_m = 0.0});
  check_.driven(1, 101, {.x_m = 0.9});
  check_.driven(1, 102, {.x_m = 0.0});
  check_.check(0, violations_);
  EXPECT_TRUE(violations_.empty());
  check_.driven(2, 100, {.x_m = 1.0});
  check_.driven(2, 101, {.x_m = 2.0});
  check_.driven(2, 102, {.x_m = 1.0});
  check_.check(0, violations_);
  EXPECT_TRUE(violations_.empty());
  EXPECT_NEAR(check_.smallest_distance_m(), 0.8, 1e-9);
}

TEST_F(Footprints, ThatTouchAreToldOnce) {
  for (std::uint64_t tick = 5; tick < 8; ++tick) {
    check_.driven(1, tick, {.x_m = 0.85});
    check_.driven(2, tick, {.x_m = 1.0});
    check_.check(0, violations_);
  }
  EXPECT_EQ(violations_.size(), 1U);
}

TEST(FootprintsAmongObstacles, ThatTouchOneAreReportedOnce) {
  FootprintsCheck check({.length_m = 0.2, .width_m = 0.1}, {{std::uint8_t{1}, Pose{}}},
                        {square_at(1.0)});
  Violations violations;
  check.driven(1, 5, {.x_m = 0.2});
  check.driven(1, 6, {.x_m = 1.0}, true);
  check.check(0, violations);
  EXPECT_TRUE(violations.empty()) << "nobody can be held responsible";
  for (std::uint64_t tick = 7; tick < 10; ++tick) check.driven(1, tick, {.x_m = 1.0});
  check.check(0, violations);
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_NE(violations.front().text.find("vehicle 1 touches an obstacle"), std::string::npos);
}

TEST_F(Footprints, OfWhoHasNotBegunOrHasEndedStand) {
  check_.driven(1, 5, {.x_m = 0.5});
  check_.check(0, violations_);
  EXPECT_TRUE(violations_.empty());
  EXPECT_NEAR(check_.smallest_distance_m(), 0.3, 1e-9);
  check_.driven(2, 6, {.x_m = 1.0});
  check_.ended(2);
  check_.driven(1, 7, {.x_m = 0.9});
  check_.check(0, violations_);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Footprints, OfAVehicleThatIsOutOfReachOrHasJustDiedMayTouch) {
  check_.driven(2, 5, {.x_m = 1.0});
  check_.driven(1, 5, {.x_m = 0.0});
  check_.driven(1, 6, {.x_m = 0.9}, true);
  check_.driven(2, 6, {.x_m = 1.0});
  check_.check(0, violations_);
  EXPECT_TRUE(violations_.empty());
  EXPECT_NEAR(check_.smallest_distance_m(), 0.8, 1e-9);
}

TEST_F(Footprints, OfADeadVehicleCountAfterAWhile) {
  check_.driven(2, 5, {.x_m = 1.0});
  check_.driven(1, 5, {.x_m = 0.0});
  check_.died(2, 3);
  check_.driven(1, 9, {.x_m = 0.0});
  check_.driven(1, 10, {.x_m = 0.9});
  check_.check(0, violations_);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST(Plans, ThatMeetAreToldWhenTheSecondComesIntoForce) {
  PlansCheck check(8);
  Violations violations;
  check.predicted(standing_at(kOne, 10, 0.0));
  check.predicted(standing_at(kTwo, 10, 0.1));
  check.reported(report_of(kOne, 10, coordination::StepStatus::kPlanned), nullptr, 0, violations);
  check.reported(report_of(kTwo, 10, coordination::StepStatus::kFallback,
                           coordination::FallbackReason::kConflict),
                 nullptr, 0, violations);
  EXPECT_TRUE(violations.empty());
  check.predicted(standing_at(kTwo, 11, 0.1));
  check.reported(report_of(kTwo, 11, coordination::StepStatus::kPlanned), nullptr, 0, violations);
  EXPECT_EQ(violations.size(), 1U);
}

/// From the end of the horizon on both stand; nothing else compares where.
TEST(Plans, ThatMeetOnlyInTheEndAreNotFree) {
  for (const double overlap_m : {5e-6, 1e-3}) {
    PlansCheck check(1);
    Violations violations;
    for (const VehicleId vehicle : {kOne, kTwo}) {
      coordination::Prediction one =
          standing_at(vehicle, 10, vehicle == kOne ? 0.0 : 0.2 - overlap_m);
      one.areas.areas_m = {square_at(vehicle == kOne ? -1.0 : 1.0)};
      check.predicted(one);
      check.reported(report_of(vehicle, 10, coordination::StepStatus::kPlanned), nullptr, 0,
                     violations);
    }
    EXPECT_EQ(violations.empty(), overlap_m < coordination::kSeparationTolerance_m) << overlap_m;
  }
}

TEST(Plans, ThatMeetAnObstacleAreReportedOnceForEachVehicle) {
  for (const bool in_the_end : {true, false}) {
    PlansCheck check(8, nullptr, {square_at(1.0)});
    Violations violations;
    const auto report_plan = [&](VehicleId vehicle, std::uint64_t step, double x_m) {
      coordination::Prediction one = standing_at(vehicle, step, in_the_end ? x_m : 9.0);
      one.areas.areas_m = {square_at(in_the_end ? -9.0 : x_m)};
      check.predicted(one);
      check.reported(report_of(vehicle, step, coordination::StepStatus::kPlanned), nullptr, 0,
                     violations);
    };
    report_plan(kOne, 10, 0.8 + 5e-6);
    EXPECT_TRUE(violations.empty()) << "within the tolerance";
    report_plan(kOne, 11, 0.9);
    report_plan(kOne, 12, 0.9);
    ASSERT_EQ(violations.size(), 1U);
    EXPECT_EQ(violations.front().text, "the plan of vehicle 1 from step 12 on meets an obstacle");
  }
}

TEST(Plans, OfWhoIsOffItsPlanOrSilentForLongAreLeftOut) {
  for (const bool is_off : {true, false}) {
    PlansCheck check(8);
    Violations violations;
    check.predicted(standing_at(kOne, 10, 0.0));
    check.reported(report_of(kOne, 10, coordination::StepStatus::kPlanned), nullptr, 0, violations);
    const std::uint64_t step = is_off ? 12 : 23;
    if (is_off) {
      check.reported(report_of(kOne, 11, coordination::StepStatus::kFallback,
                               coordination::FallbackReason::kDeviation),
                     nullptr, 0, violations);
    }
    check.predicted(standing_at(kTwo, step, 0.1));
    check.reported(report_of(kTwo, step, coordination::StepStatus::kPlanned), nullptr, 0,
                   violations);
    EXPECT_TRUE(violations.empty());
  }
}

TEST(Plans, OfWhoIsSilentAndHasNeverReceivedItsPlanAreLeftOut) {
  for (const bool is_received : {true, false}) {
    for (const bool is_silent : {true, false}) {
      PlansCheck check(8);
      Violations violations;
      check.predicted(standing_at(kOne, 10, 0.0));
      check.reported(report_of(kOne, 10, coordination::StepStatus::kPlanned), nullptr, 0,
                     violations);
      check.received(kOne, is_received);
      const std::uint64_t step = is_silent ? 12 : 11;
      check.predicted(standing_at(kTwo, step, 0.1));
      check.reported(report_of(kTwo, step, coordination::StepStatus::kPlanned), nullptr, 0,
                     violations);
      EXPECT_EQ(violations.empty(), is_silent && !is_received);
    }
  }
}

TEST(Reasons, WhoEndsBadlyHasComplained) {
  ReasonsCheck check;
  Violations violations;
  check.started("a");
  check.log("a", machine::info("waiting"), 1);
  check.ended("a", 4, 2, violations);
  EXPECT_EQ(violations.size(), 1U);
  check.log("a", machine::error("b is gone"), 3);
  check.ended("a", 4, 4, violations);
  check.ended("c", 0, 5, violations);
  check.ended("d", 130, 6, violations);
  EXPECT_EQ(violations.size(), 1U);
}

TEST(Reasons, AVehicleThatStopsSaysSoInTheSameTurn) {
  ReasonsCheck check;
  Violations violations;
  check.driven("a", true, 10);
  check.driven("a", false, 20);
  check.log("a", machine::warning("stops"), 20);
  check.check(100, violations);
  EXPECT_TRUE(violations.empty());
  check.driven("a", true, 110);
  check.driven("a", false, 120);
  check.check(200, violations);
  EXPECT_EQ(violations.size(), 1U);
}

TEST(Reasons, AFallbackThatOnlyOthersCauseNamesThem) {
  using enum coordination::FallbackReason;
  Violations violations;
  coordination::Report report = report_of(kOne, 1, coordination::StepStatus::kFallback);
  for (const auto reason :
       {kNone, kInfeasible, kLate, kDeviation, kConflict, kMissing, kNeighbour}) {
    report.reason = reason;
    ReasonsCheck::reported(report, 2, violations);
  }
  ASSERT_EQ(violations.size(), 2U);
  EXPECT_EQ(violations[0].text,
            "vehicle 1 falls back, missing, and does not name because of which");
  report.blocked_by = {kTwo};
  ReasonsCheck::reported(report, 2, violations);
  EXPECT_EQ(violations.size(), 2U);
}

TEST(Planning, WhoIsAbleHasPlannedOrFoundThatThereIsNoWay) {
  PlanningCheck check(100);
  Violations violations;
  check.report({.report = report_of(kOne, 1, coordination::StepStatus::kPlanned)}, 50);
  check.report({.report = report_of(kTwo, 1, coordination::StepStatus::kFallback,
                                    coordination::FallbackReason::kInfeasible)},
               150);
  check.check({2}, 200, violations);
  EXPECT_TRUE(violations.empty());
  check.check({1, 2}, 200, violations);
  ASSERT_EQ(violations.size(), 1U);
  check.report({.report = report_of(kOne, 2, coordination::StepStatus::kPlanned)}, 150);
  check.check({1, 2}, 200, violations);
  EXPECT_EQ(violations.size(), 1U);
}

}  // namespace
}  // namespace hlc::closed_loop
