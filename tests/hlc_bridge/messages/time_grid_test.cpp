#include "hlc_bridge/messages/time_grid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hlc::time_grid_test {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kMs = 1'000'000;

TEST(TimeGrid, StepNumberComesFromTheTimeOfTheList) {
  EXPECT_EQ(step_at(1, kPeriod), 0U);
  EXPECT_EQ(step_at(3 * kPeriod + 1, kPeriod), 3U);
  EXPECT_EQ(step_at(4 * kPeriod - 1, kPeriod), 3U);
}

TEST(TimeGrid, VehicleTickAtAStepsBeginStillFollowsTheListBefore) {
  EXPECT_EQ(last_list_before(2 * kPeriod, kPeriod), kPeriod + 1);
  EXPECT_EQ(last_list_before(2 * kPeriod + 20 * kMs, kPeriod), 2 * kPeriod + 1);
}

TEST(TimeGrid, NoListPrecedesTheFirstOne) {
  EXPECT_EQ(last_list_before(0, kPeriod), std::nullopt);
  EXPECT_EQ(last_list_before(1, kPeriod), std::nullopt);
  EXPECT_EQ(last_list_before(2, kPeriod), 1U);
}

TEST(TimeGrid, LastListBeforeIsStrictlyBeforeAndTheNextIsNot) {
  std::mt19937_64 random{11};
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds period = std::uniform_int_distribution<Nanoseconds>{2, 1000}(random);
    const Nanoseconds t = std::uniform_int_distribution<Nanoseconds>{2, 5000}(random);
    const Nanoseconds list = last_list_before(t, period).value();
    EXPECT_EQ(list % period, kListOffset % period) << "t " << t << ", period " << period;
    EXPECT_LT(list, t) << "period " << period;
    EXPECT_GE(list + period, t) << "period " << period;
  }
}

TEST(TimeGrid, NewestValidStateIsSixtyMillisecondsOldAtAList) {
  EXPECT_EQ(newest_valid_state_stamp(kPeriod + 1), kPeriod - 60 * kMs);
  EXPECT_EQ(newest_valid_state_stamp(kPeriod - 1), kPeriod - 80 * kMs);
}

TEST(TimeGrid, NoStateIsValidInTheFirstSixtyMilliseconds) {
  EXPECT_EQ(newest_valid_state_stamp(1), std::nullopt);
  EXPECT_EQ(newest_valid_state_stamp(60 * kMs), std::nullopt);
  EXPECT_EQ(newest_valid_state_stamp(60 * kMs + 1), 0U);
}

TEST(TimeGrid, NextOnGridIsTheFirstNotBefore) {
  EXPECT_EQ(next_on_grid(0, kPeriod, 1), 1U);
  EXPECT_EQ(next_on_grid(1, kPeriod, 1), 1U);
  EXPECT_EQ(next_on_grid(2, kPeriod, 1), kPeriod + 1);
  EXPECT_EQ(next_on_grid(kPeriod + 1, kPeriod, 1), kPeriod + 1);
}

}  // namespace
}  // namespace hlc::time_grid_test
