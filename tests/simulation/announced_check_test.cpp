#include "vehicle_sim/closed_loop/announced_check.hpp"

#include <gtest/gtest.h>

namespace hlc::closed_loop {
namespace {

constexpr VehicleId kCar{1};
constexpr Footprint kFootprint{.length_m = 0.2, .width_m = 0.1};
constexpr Nanoseconds kAnnouncedPeriod = 200 * kNanosecondsPerMillisecond;

coordination::OccupiedAreas stands_at(std::uint64_t first, double x_m) {
  return {.first = {first}, .final_area_m = footprint_area(kFootprint, {.x_m = x_m}, 0.01)};
}

class Announced : public testing::Test {
 protected:
  void drive(double x_m, Nanoseconds from, Nanoseconds until, double speed_mps = 0.0) {
    for (Nanoseconds tick = from; tick < until; tick += kVehiclePeriod) {
      check_.driven(kCar, tick, {.x_m = x_m}, speed_mps, violations_);
    }
  }
  void publish(std::uint64_t step, double x_m) {
    check_.published({.vehicle = kCar, .step = {step}, .running = stands_at(step, x_m)});
  }
  void agree(std::uint64_t step, double x_m) {
    check_.predicted({.vehicle = kCar, .step = {step}, .areas = stands_at(step + 1, x_m)});
    check_.reported({.vehicle = kCar, .step = {step}, .status = coordination::StepStatus::kPlanned},
                    step * kAnnouncedPeriod);
  }

  AnnouncedCheck check_{kFootprint, 8, kAnnouncedPeriod};
  Violations violations_;
};

TEST_F(Announced, AVehicleMayBeOutsideForHalfASecond) {
  publish(0, 0.0);
  drive(0.5, 0, 500 * kNanosecondsPerMillisecond);
  drive(0.0, 500 * kNanosecondsPerMillisecond, 600 * kNanosecondsPerMillisecond);
  drive(0.5, 600 * kNanosecondsPerMillisecond, 1100 * kNanosecondsPerMillisecond);
  EXPECT_TRUE(violations_.empty());
  drive(0.5, 1100 * kNanosecondsPerMillisecond, 1300 * kNanosecondsPerMillisecond);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "announced");
}

TEST_F(Announced, TheLastPlanCountsAndTheOneBeforeSinceACommandMayBeLost) {
  publish(0, 0.0);
  agree(0, 0.5);
  drive(0.5, kAnnouncedPeriod, 10 * kAnnouncedPeriod);
  drive(0.0, 10 * kAnnouncedPeriod, 15 * kAnnouncedPeriod);
  EXPECT_TRUE(violations_.empty());
  publish(15, 0.5);
  agree(15, 1.0);
  drive(0.0, 16 * kAnnouncedPeriod, 20 * kAnnouncedPeriod);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Announced, APlanWhoseControllerDiesBeforeItsReportMayBeDriven) {
  publish(0, 0.0);
  check_.predicted({.vehicle = kCar, .step = {0}, .areas = stands_at(1, 0.5)});
  check_.controller_died(kCar);
  drive(0.5, kAnnouncedPeriod, 10 * kAnnouncedPeriod);
  drive(0.0, 10 * kAnnouncedPeriod, 20 * kAnnouncedPeriod);
  EXPECT_TRUE(violations_.empty());
  drive(1.0, 20 * kAnnouncedPeriod, 25 * kAnnouncedPeriod);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Announced, APlanThatWasPredictedAndDidNotComeIntoForceIsNotDriven) {
  publish(0, 0.0);
  check_.predicted({.vehicle = kCar, .step = {0}, .areas = stands_at(1, 0.5)});
  check_.reported({.vehicle = kCar, .step = {0}, .status = coordination::StepStatus::kFallback}, 0);
  check_.controller_died(kCar);
  drive(0.5, kAnnouncedPeriod, 10 * kAnnouncedPeriod);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Announced, AVehicleStandsWhenItsLastPlanHasRunOut) {
  publish(0, 0.0);
  agree(0, 0.0);
  drive(0.0, kAnnouncedPeriod, check_.plan_lasts(), 0.5);
  EXPECT_TRUE(violations_.empty());
  drive(0.0, check_.plan_lasts(), 20 * kAnnouncedPeriod, 0.5);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "stands");
}

TEST_F(Announced, WhatIsForgivenIsNotJudgedUntilItsControllerHasSeenTheVehicle) {
  publish(0, 0.0);
  check_.exempt(kCar, 0);
  check_.published({.vehicle = kCar, .step = {1}, .running = stands_at(1, 0.0)}, false);
  drive(0.5, 0, 5 * kAnnouncedPeriod);
  EXPECT_TRUE(check_.is_exempt(kCar));
  EXPECT_TRUE(violations_.empty());
  publish(5, 0.0);
  EXPECT_FALSE(check_.is_exempt(kCar));
  drive(0.5, 5 * kAnnouncedPeriod, 9 * kAnnouncedPeriod);
  EXPECT_EQ(violations_.size(), 1U);
}

TEST_F(Announced, WhatIsForgivenMustStandAllTheSame) {
  publish(0, 0.0);
  check_.exempt(kCar, 0);
  drive(0.5, 0, check_.plan_lasts() + kAnnouncedPeriod, 0.5);
  ASSERT_EQ(violations_.size(), 1U);
  EXPECT_EQ(violations_.front().check, "stands");
}

TEST_F(Announced, WhatIsForgivenIsNotJudgedUntilTheNextAnnouncement) {
  publish(0, 0.0);
  check_.exempt(kCar, 0);
  drive(0.5, 0, 10 * kAnnouncedPeriod);
  EXPECT_TRUE(violations_.empty());
  publish(10, 0.0);
  drive(0.5, 10 * kAnnouncedPeriod, 14 * kAnnouncedPeriod);
  EXPECT_EQ(violations_.size(), 1U);
}

}  // namespace
}  // namespace hlc::closed_loop
