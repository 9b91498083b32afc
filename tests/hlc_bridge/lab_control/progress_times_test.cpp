#include "hlc_bridge/lab_control/progress_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace hlc::lab_control::progress_times_test {
namespace {

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;

TEST(ProgressTimes, AreEveryIntervalAfterTheFirstSecond) {
  ProgressTimes times(5 * kSecond);
  std::vector<Nanoseconds> due;
  for (Nanoseconds t = 100 * kSecond; t < 111 * kSecond; t += kSecond / 10) {
    if (times.is_due(t)) due.push_back(t / kSecond);
  }
  EXPECT_THAT(due, testing::ElementsAre(101, 106)) << "nothing in the first second";
}

TEST(ProgressTimes, NextIsWhenTheNextIsDue) {
  ProgressTimes times(kSecond / 10);
  EXPECT_EQ(times.next(), std::nullopt);
  EXPECT_FALSE(times.is_due(100 * kSecond));
  EXPECT_EQ(times.next(), 101 * kSecond);
  EXPECT_FALSE(times.is_due(*times.next() - 1));
  EXPECT_TRUE(times.is_due(*times.next()));
  EXPECT_EQ(times.next(), 101 * kSecond + kSecond / 10);
}

}  // namespace
}  // namespace hlc::lab_control::progress_times_test
