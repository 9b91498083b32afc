#include "planner/controller/obstacles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::controller::obstacles_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr StepIndex kNow{10};

ConvexPolygon square_at(double x) { return footprint_area({1.0, 1.0}, {x, 0.0, 0.0}); }

MATCHER_P(LiesAt, x, "") { return arg.vertices_m == square_at(x).vertices_m; }

/// Drives from 0 to 2 in the steps 10 and 11, reaches as far as 9.
const coordination::Traffic kDrives{.vehicle = {1},
                                    .step = kNow,
                                    .running = {.first = kNow,
                                                .areas_m = {square_at(0.0), square_at(1.0)},
                                                .final_area_m = square_at(2.0)},
                                    .reachable_area_m = square_at(9.0)};
const coordination::Traffic kStands{
    .vehicle = {1},
    .step = kNow,
    .running = {.first = kNow, .areas_m = {}, .final_area_m = square_at(3.0)},
    .reachable_area_m = square_at(9.0)};

coordination::Prediction prediction(bool is_new) {
  return {.vehicle = {1},
          .step = kNow,
          .is_new = is_new,
          .areas = {.first = {11}, .areas_m = {}, .final_area_m = square_at(5.0)}};
}

/// During the step 11.
std::vector<ConvexPolygon> areas_m(CoupledObstacleRule rule, const CoupledVehicle& other) {
  return obstacles_m(std::vector{other}, rule, {}, {}, kNow, 1, 0.2).front();
}

TEST(OldAndNewPlans, HoldWhatIsDrivenAndWhatAPredecessorHasPlanned) {
  const coordination::Prediction plans = prediction(true);
  const coordination::Prediction keeps = prediction(false);
  EXPECT_THAT(areas_m(old_and_new_plans, {&kDrives, nullptr, false}), ElementsAre(LiesAt(1.0)));
  EXPECT_THAT(areas_m(old_and_new_plans, {&kDrives, &plans, true}),
              ElementsAre(LiesAt(5.0), LiesAt(1.0)));
  EXPECT_THAT(areas_m(old_and_new_plans, {&kDrives, &keeps, true}), ElementsAre(LiesAt(1.0)));
}

TEST(OldAndNewPlans, HoldAllThatAPredecessorCanReachThatWasNotReceived) {
  EXPECT_THAT(areas_m(old_and_new_plans, {&kDrives, nullptr, true}),
              ElementsAre(LiesAt(9.0), LiesAt(1.0)));
}

TEST(PredictionsAndStandingSuccessors, HoldNothingOfASuccessorThatDrives) {
  const auto rule = predictions_and_standing_successors;
  const coordination::Prediction keeps = prediction(false);
  EXPECT_THAT(areas_m(rule, {&kDrives, nullptr, false}), IsEmpty());
  EXPECT_THAT(areas_m(rule, {&kStands, nullptr, false}), ElementsAre(LiesAt(3.0)));
  EXPECT_THAT(areas_m(rule, {&kDrives, &keeps, true}), ElementsAre(LiesAt(5.0)));
  EXPECT_THAT(areas_m(rule, {&kStands, nullptr, true}), ElementsAre(LiesAt(9.0)));
}

TEST(Obstacles, AMissingVehicleMayBeAnywhereUntilItStandsForGood) {
  const coordination::MissingVehicleRules rules{.max_speed_mps = 1.0, .footprint = {0.2, 0.1}};
  const coordination::MeasuredVehicle seen{
      .vehicle = {1}, .pose = {}, .speed_mps = 0.0, .age_s = 0.0};
  const auto of = [&](bool stands) {
    return obstacles_m({}, old_and_new_plans, std::vector{MissingVehicle{&seen, stands}}, rules,
                       kNow, 3, 0.2);
  };
  ASSERT_EQ(of(false).size(), 3U);
  EXPECT_FALSE(contains(of(false)[0].front(), Point(0.55, 0.0)));
  EXPECT_TRUE(contains(of(false)[2].front(), Point(0.55, 0.0))) << "it has had more time";
  EXPECT_FALSE(contains(of(true)[2].front(), Point(0.15, 0.0)));
}

}  // namespace
}  // namespace hlc::controller::obstacles_test
