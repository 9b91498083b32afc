#include "planner/coordination/waiting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/coordination/report.hpp"

namespace hlc::coordination::waiting_test {
namespace {

constexpr double kStep_s = 0.2;

/// Car 3 in step k, waiting for cars 1 and 2 since step 50.
Report waiting(std::uint64_t k) {
  return {.vehicle = {3}, .step = {k}, .waiting = {.vehicles = {{1}, {2}}, .since = {50}}};
}

TEST(Waiting, LastsFromItsFirstStepToTheEndOfTheReported) {
  EXPECT_DOUBLE_EQ(wait_s(waiting(50), kStep_s), 0.2);
  EXPECT_DOUBLE_EQ(wait_s(waiting(59), kStep_s), 2.0);
  EXPECT_EQ(wait_s({.vehicle = {3}, .step = {59}}, kStep_s), 0.0);
}

TEST(Waiting, IsStuckAfterTwentySeconds) {
  EXPECT_FALSE(is_stuck(waiting(148), kStep_s));
  EXPECT_TRUE(is_stuck(waiting(149), kStep_s));
  EXPECT_FALSE(is_stuck({.vehicle = {3}, .step = {500}}, kStep_s));
}

TEST(Waiting, AVehicleThatHasNotMovedSinceTheStartIsToldSo) {
  StuckNotice notice;
  EXPECT_FALSE(notice.note(waiting(50), kStep_s));
  EXPECT_THAT(notice.note(waiting(149), kStep_s).value(),
              testing::HasSubstr("; it has not moved since its controller began: if "));
}

TEST(Waiting, IsNoticedOnceAndAgainAfterABreak) {
  StuckNotice notice;
  Report elsewhere{.vehicle = {3}, .step = {20}};
  elsewhere.planned_pose.x_m = 0.3;
  EXPECT_FALSE(notice.note(elsewhere, kStep_s));
  EXPECT_FALSE(notice.note(waiting(148), kStep_s));
  const std::optional<std::string> line = notice.note(waiting(149), kStep_s);
  ASSERT_TRUE(line);
  EXPECT_EQ(*line,
            "stuck: vehicle 3, waiting for 1, 2 for 20.0 s, although its road would be free "
            "without the others");
  EXPECT_FALSE(notice.note(waiting(150), kStep_s));
  EXPECT_FALSE(notice.note({.vehicle = {3}, .step = {151}}, kStep_s));
  EXPECT_TRUE(notice.note(waiting(300), kStep_s));
}

}  // namespace
}  // namespace hlc::coordination::waiting_test
