#include "planner/coordination/missing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hlc::coordination {
namespace {

const MissingVehicleRules kRules{.max_speed_mps = 0.8,
                                 .circumradius_m = 0.14,
                                 .footprint = {0.22, 0.107},
                                 .safety_margin_m = 0.01};

MeasuredVehicle standing() {
  return {.vehicle = {2}, .pose = {1.0, 2.0, 0.3}, .speed_mps = 0.0, .age_s = 0.06};
}

TEST(Missing, TheDiscHoldsTheFootprintOfEveryMotionWithinTheTopSpeed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double horizon_s = 0.6;
  const ConvexPolygon disc = reachable_disc(standing(), horizon_s, kRules);
  for (int i = 0; i < 2000; ++i) {
    const double direction = angle(random);
    const double way =
        (i % 2 == 0 ? 1.0 : unit(random)) * kRules.max_speed_mps * (standing().age_s + horizon_s);
    const Pose pose{standing().pose.x_m + way * std::cos(direction),
                    standing().pose.y_m + way * std::sin(direction), angle(random)};
    for (const Point& corner :
         footprint_area(kRules.footprint, pose, kRules.safety_margin_m).vertices_m) {
      ASSERT_TRUE(contains(disc, corner, 1e-12)) << "case " << i;
    }
  }
}

TEST(ReachableDisc, DoesNotShrinkByALeadOrAStampAfterTheStepsBegin) {
  MeasuredVehicle measured = standing();
  measured.age_s = 0.0;
  const ConvexPolygon disc = reachable_disc(measured, 0.6, kRules);
  measured.pose_lead_s = 0.1;
  EXPECT_EQ(reachable_disc(measured, 0.6, kRules).vertices_m, disc.vertices_m);
  measured.age_s = -0.05;
  EXPECT_EQ(reachable_disc(measured, 0.6, kRules).vertices_m, disc.vertices_m);
}

constexpr std::size_t kHorizon = 8;
constexpr std::uint64_t kLongest = kSilentSteps + kHorizon + 1;

TEST(Missing, AVehicleStandsForGoodOnlyWhenEveryPlanItCanHaveHasRunOut) {
  const StepIndex early{1};
  EXPECT_FALSE(stands_for_good({{100 + kLongest}, {100}, early}, kHorizon));
  EXPECT_TRUE(stands_for_good({{101 + kLongest}, {100}, early}, kHorizon));
}

TEST(Missing, AStopInTheMiddleOfAPlanIsNotStandingForGood) {
  const StepIndex early{1};
  EXPECT_FALSE(stands_for_good({{100 + kLongest}, early, {100}}, kHorizon));
  EXPECT_TRUE(stands_for_good({{101 + kLongest}, early, {100}}, kHorizon));
}

TEST(Missing, OnlyAFreshStateShowsAVehicleStanding) {
  EXPECT_TRUE(is_seen_standing(standing(), kRules));
  MeasuredVehicle moving = standing();
  moving.speed_mps = 0.1;
  EXPECT_FALSE(is_seen_standing(moving, kRules));
  MeasuredVehicle unseen = standing();
  unseen.age_s = 0.3;
  EXPECT_FALSE(is_seen_standing(unseen, kRules));
}

}  // namespace
}  // namespace hlc::coordination
