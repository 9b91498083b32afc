#include "vehicle_sim/closed_loop/driven_plans.hpp"

#include <gtest/gtest.h>

#include <map>

#include "planner/geometry/footprint.hpp"

namespace hlc::closed_loop {
namespace {

constexpr VehicleId kFirst{1};
constexpr VehicleId kSecond{2};
constexpr Nanoseconds kDrivenPeriod = 200 * kNanosecondsPerMillisecond;

coordination::OccupiedAreas area_at(std::uint64_t first, double x_m) {
  return {.first = {first},
          .final_area_m = footprint_area({.length_m = 0.2, .width_m = 0.2}, {.x_m = x_m})};
}

/// Vehicles whose controllers agree in step k to stand somewhere, and command so.
class Driven : public testing::Test {
 protected:
  void agree(VehicleId vehicle, std::uint64_t step, double x_m) {
    publish(vehicle, step);
    agreed_m_[vehicle] = x_m;
    driven_.predicted({.vehicle = vehicle, .step = {step}, .areas = area_at(step + 1, x_m)});
    driven_.commanded(command(vehicle, step), step * kDrivenPeriod + 1, violations_);
    const coordination::Plan plan({step}, {.x_m = x_m}, standstill_);
    driven_.reported(
        {.vehicle = vehicle, .step = {step}, .status = coordination::StepStatus::kPlanned}, &plan);
  }
  /// The plan in force: to stand.
  void publish(VehicleId vehicle, std::uint64_t step, bool is_seen = true) {
    driven_.published(
        {.vehicle = vehicle, .step = {step}, .running = area_at(step, agreed_m_[vehicle])},
        is_seen);
  }
  static TrajectoryCommand command(VehicleId vehicle, std::uint64_t step) {
    return {.vehicle_id = vehicle.value,
            .create_stamp = step * kDrivenPeriod + 1,
            .valid_after_stamp = step * kDrivenPeriod + 1,
            .points = {{}}};
  }
  void receive(VehicleId vehicle, std::uint64_t step) { driven_.received(command(vehicle, step)); }
  void drive(VehicleId vehicle, std::uint64_t step, std::uint64_t command_of) {
    driven_.driven(vehicle, step * kDrivenPeriod + kVehiclePeriod, command_of * kDrivenPeriod + 1,
                   violations_);
  }

  std::map<VehicleId, double> agreed_m_;
  automaton::Maneuver standstill_;
  DrivenPlans driven_{8, kDrivenPeriod};
  Violations violations_;
};

TEST_F(Driven, PlansOfTwoVehiclesThatMeetAreViolations) {
  agree(kFirst, 10, 0.0);
  receive(kFirst, 10);
  drive(kFirst, 10, 10);
  agree(kSecond, 10, 0.1);
  EXPECT_TRUE(violations_.empty()) << "it does not drive it";
  receive(kSecond, 10);
  drive(kSecond, 10, 10);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "driven");
}

TEST_F(Driven, APlanThatWasNotReceivedIsNotDriven) {
  agree(kFirst, 10, 0.0);
  receive(kFirst, 10);
  drive(kFirst, 10, 10);
  agree(kFirst, 11, 1.0);
  agree(kSecond, 11, 0.1);
  receive(kSecond, 11);
  drive(kSecond, 11, 11);
  EXPECT_EQ(violations_.size(), 1U) << "one still drives its plan of step 10";
}

TEST_F(Driven, AVehicleIsOutOfReachOnceItsControllerIsMistakenAboutIt) {
  agree(kFirst, 10, 0.0);
  receive(kFirst, 10);
  drive(kFirst, 10, 10);
  agree(kFirst, 11, 1.0);
  drive(kFirst, 11, 10);
  EXPECT_FALSE(driven_.is_out_of_reach(kFirst, 12 * kDrivenPeriod));
  publish(kFirst, 12);
  drive(kFirst, 12, 10);
  EXPECT_FALSE(driven_.is_out_of_reach(kFirst, 12 * kDrivenPeriod));
  drive(kFirst, 13, 10);
  EXPECT_TRUE(driven_.is_out_of_reach(kFirst, 13 * kDrivenPeriod));
  agree(kSecond, 13, 0.1);
  receive(kSecond, 13);
  drive(kSecond, 13, 13);
  EXPECT_TRUE(violations_.empty());
  receive(kFirst, 11);
  drive(kFirst, 13, 11);
  EXPECT_FALSE(driven_.is_out_of_reach(kFirst, 13 * kDrivenPeriod + 2 * driven_.afterwards()));
}

TEST_F(Driven, AVehicleThatChangesOverLateAndIsThenSeenOffItsPlanIsOutOfReach) {
  for (const bool is_seen_off : {false, true}) {
    SCOPED_TRACE(is_seen_off);
    driven_ = DrivenPlans{8, kDrivenPeriod};
    agree(kFirst, 10, 0.0);
    receive(kFirst, 10);
    drive(kFirst, 10, 10);
    agree(kFirst, 11, 1.0);
    drive(kFirst, 11, 10);
    receive(kFirst, 11);
    drive(kFirst, 12, 11);
    driven_.reported({.vehicle = kFirst,
                      .step = {13},
                      .reason = is_seen_off ? coordination::FallbackReason::kDeviation
                                            : coordination::FallbackReason::kMissing},
                     nullptr);
    EXPECT_EQ(driven_.is_out_of_reach(kFirst, 13 * kDrivenPeriod), is_seen_off);
  }
}

/// Of steps 11 and 12 only the later command arrives, after the plan of step 11 has begun.
TEST_F(Driven, AVehicleThatChangesOverLateToALaterPlanIsOutOfReachUntilTheNextStep) {
  for (const bool is_late : {false, true}) {
    SCOPED_TRACE(is_late);
    driven_ = DrivenPlans{8, kDrivenPeriod};
    agree(kFirst, 10, 0.0);
    receive(kFirst, 10);
    drive(kFirst, 10, 10);
    agree(kFirst, 11, 1.0);
    if (!is_late) receive(kFirst, 11);
    drive(kFirst, 11, is_late ? 10 : 11);
    agree(kFirst, 12, 2.0);
    receive(kFirst, 12);
    drive(kFirst, 12, 12);
    drive(kFirst, 12, 12);
    EXPECT_EQ(driven_.is_out_of_reach(kFirst, 12 * kDrivenPeriod + kVehiclePeriod), is_late);
  }
}

TEST_F(Driven, AVehicleThatHasChangedOverLateIsOutOfReachWhileTheSecondListIsOverdue) {
  agree(kFirst, 10, 0.0);
  receive(kFirst, 10);
  drive(kFirst, 10, 10);
  agree(kFirst, 11, 1.0);
  drive(kFirst, 11, 10);
  receive(kFirst, 11);
  drive(kFirst, 12, 11);
  publish(kFirst, 13);
  driven_.reported({.vehicle = kFirst, .step = {13}}, nullptr);
  const auto is_out_of_reach_in = [this](std::uint64_t step) {
    drive(kFirst, step, 11);
    drive(kFirst, step, 11);
    return driven_.is_out_of_reach(kFirst, step * kDrivenPeriod + kVehiclePeriod);
  };
  EXPECT_FALSE(is_out_of_reach_in(13));
  EXPECT_FALSE(is_out_of_reach_in(14));
  EXPECT_TRUE(is_out_of_reach_in(15));
  publish(kFirst, 16);
  EXPECT_FALSE(is_out_of_reach_in(16));
}

TEST_F(Driven, AControllerThatDoesNotSeeItsVehicleIsNotMistaken) {
  for (const bool is_seen : {false, true}) {
    SCOPED_TRACE(is_seen);
    driven_ = DrivenPlans{8, kDrivenPeriod};
    agree(kFirst, 10, 0.0);
    receive(kFirst, 10);
    drive(kFirst, 10, 10);
    agree(kFirst, 11, 1.0);
    for (std::uint64_t step = 12; step < 15; ++step) publish(kFirst, step, is_seen);
    drive(kFirst, 14, 10);
    EXPECT_EQ(driven_.is_out_of_reach(kFirst, 14 * kDrivenPeriod), is_seen);
  }
}

TEST_F(Driven, AVehicleThatIsNotSeenIsSentNothingUntilItsControllerIsRestarted) {
  agree(kFirst, 10, 0.0);
  publish(kFirst, 11, false);
  driven_.commanded(command(kFirst, 10), 10 * kDrivenPeriod + 2, violations_);
  EXPECT_TRUE(violations_.empty()) << "a copy";
  driven_.controller_started(kFirst);
  driven_.commanded(command(kFirst, 11), 11 * kDrivenPeriod + 1, violations_);
  EXPECT_TRUE(violations_.empty());
  publish(kFirst, 12, false);
  driven_.commanded(command(kFirst, 12), 12 * kDrivenPeriod + 1, violations_);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "commands");
}

TEST_F(Driven, AVehicleThatChangesOverInTimeIsInReachEvenIfItIsSeenOffItsPlan) {
  for (std::uint64_t step = 10; step < 12; ++step) {
    agree(kFirst, step, 0.1 * static_cast<double>(step));
    receive(kFirst, step);
    drive(kFirst, step, step);
  }
  driven_.reported(
      {.vehicle = kFirst, .step = {12}, .reason = coordination::FallbackReason::kDeviation},
      nullptr);
  EXPECT_FALSE(driven_.is_out_of_reach(kFirst, 12 * kDrivenPeriod));
}

TEST_F(Driven, AfterItsPlanAVehicleStandsWhereItsControllerAnnounces) {
  agree(kFirst, 10, 0.0);
  receive(kFirst, 10);
  drive(kFirst, 10, 10);
  driven_.published({.vehicle = kFirst, .step = {12}, .running = area_at(12, 1.0)});
  driven_.reported({.vehicle = kFirst, .step = {12}}, nullptr);
  agree(kSecond, 12, 0.0);
  receive(kSecond, 12);
  drive(kSecond, 12, 12);
  EXPECT_TRUE(violations_.empty());
  agree(kSecond, 13, 1.0);
  receive(kSecond, 13);
  drive(kSecond, 13, 13);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Driven, AVehicleFollowsTheNewestCommandThatItHas) {
  for (std::uint64_t step = 10; step < 12; ++step) {
    agree(kFirst, step, 0.0);
    receive(kFirst, step);
  }
  drive(kFirst, 11, 11);
  EXPECT_TRUE(violations_.empty());
  drive(kFirst, 11, 10);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "commands");
}

}  // namespace
}  // namespace hlc::closed_loop
