#include "planner/controller/command_time.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::controller::command_time_test {
namespace {

TEST(CommandTime, AsManyCopiesAreSentAsAPlanAndOneStepMoreNeed) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(1000); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::size_t steps = 1 + random() % 20;
    const double step_s = 0.02 * static_cast<double>(1 + random() % 40);
    const double planned_s = static_cast<double>(steps + 1) * step_s;
    const std::size_t copies = num_copies(steps, step_s);
    EXPECT_GE(followed_s(copies), planned_s - 1e-9);
    if (copies > 1) {
      EXPECT_LT(followed_s(copies - 1), planned_s);
    }
    EXPECT_GE(static_cast<double>(drivable_steps(steps, step_s)) * step_s,
              followed_s(copies) + step_s - 1e-9);
    EXPECT_LT(static_cast<double>(drivable_steps(steps, step_s)) * step_s,
              followed_s(copies) + 2.0 * step_s + 1e-9);
  }
}

TEST(CommandTime, EightStepsOfAFifthOfASecondNeedOneCopyAndAreDrivenForTenSteps) {
  EXPECT_EQ(num_copies(8, 0.2), 1U);
  EXPECT_EQ(drivable_steps(8, 0.2), 10U);
}

// A vehicle follows a command for 1.8 s, which is 18 steps of 0.1 s: ten steps were too few, and a
// plan was forgotten that the vehicle could still drive.
TEST(CommandTime, InShorterStepsAReplacedPlanIsRememberedForMoreOfThem) {
  EXPECT_EQ(drivable_steps(17, 0.1), 19U);
}

TEST(CommandTime, AFullSizeCarsPlanOfTwoAndAHalfSecondsNeedsThreeCopies) {
  EXPECT_EQ(num_copies(5, 0.5), 3U);
  EXPECT_EQ(drivable_steps(5, 0.5), 8U);
}

}  // namespace
}  // namespace hlc::controller::command_time_test
