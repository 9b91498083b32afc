#include "hlc_bridge/hlc/pose_lead.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planner/controller/east_bound.hpp"

namespace hlc::high_level_controller::pose_lead_test {
namespace {

using controller::Controller;
using controller::east_bound::at;
using controller::east_bound::following;
using controller::east_bound::seen;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const vehicle::LabLimits kWideLab{.curvature_min_per_m = -10.0,
                                  .curvature_max_per_m = 10.0,
                                  .acceleration_max_mps2 = 100.0,
                                  .velocity_mismatch_max_mps = 1.0,
                                  .x_min_m = -30.0,
                                  .x_max_m = 30.0,
                                  .y_min_m = -30.0,
                                  .y_max_m = 30.0,
                                  .point_interval_s = 0.025};

/// Lines of a car that drives east from step 100 on, each pose measured `ahead_s` too early, and in
/// every fourth step far off.
std::vector<std::string> lines(double ahead_s, std::uint64_t steps) {
  const auto one = std::make_unique<Controller>(
      controller::ControllerOptions{.vehicle = {1}, .lab = kWideLab},
      controller::east_bound::subgraph(),
      road::ReferencePath({Point(0.0, 0.0), Point(20.0, 0.0)}, false), road::Corridor{});
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  PoseLeadCheck check;
  std::vector<std::string> result;
  for (std::uint64_t k = 101; k < 101 + steps; ++k) {
    const coordination::MeasuredVehicle measured = following(*one, k);
    coordination::MeasuredVehicle early = measured;
    early.pose.x_m += ahead_s * measured.speed_mps + (k % 4 == 0 ? 0.05 : 0.0);
    if (const auto line = check.note(*one, at(k, {early}))) result.push_back(*line);
    static_cast<void>(one->observe(at(k, {measured})));
    one->couple({});
    static_cast<void>(one->plan({}));
    static_cast<void>(one->commit({}, {}));
  }
  return result;
}

TEST(PoseLead, WithinTheToleranceIsNotLogged) {
  for (const double ahead_s : {-0.0045, 0.0, 0.0045}) EXPECT_TRUE(lines(ahead_s, 60).empty());
}

TEST(PoseLead, BeyondTheToleranceIsLoggedOnceWithItsValue) {
  EXPECT_THAT(lines(0.020, 60), testing::ElementsAre(HasSubstr("is 0.000: set it to 0.020")));
  EXPECT_THAT(lines(-0.008, 60),
              testing::ElementsAre(AllOf(HasSubstr("about -8 ms ahead"), HasSubstr("its clock"),
                                         Not(HasSubstr("set it")))));
}

TEST(PoseLead, OfFewStepsIsNotJudged) {
  EXPECT_TRUE(lines(0.020, PoseLeadCheck::kLeastSteps + 1).empty()) << "in two it is too slow";
  EXPECT_EQ(lines(0.020, PoseLeadCheck::kLeastSteps + 2).size(), 1U);
}

TEST(PoseLead, OfAStandingOrUnseenCarIsNotJudged) {
  const auto one = controller::east_bound::controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  PoseLeadCheck check;
  for (std::uint64_t k = 101; k < 200; ++k) {
    EXPECT_FALSE(check.note(*one, at(k, {seen(1, 0.1, 0.0)})));
    EXPECT_FALSE(check.note(*one, at(k, {})));
  }
}

}  // namespace
}  // namespace hlc::high_level_controller::pose_lead_test
