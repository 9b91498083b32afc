#include "hlc_bridge/machine/wait_notice.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hlc::machine {
namespace {

TEST(WaitNotice, ComesAtTheGivenPauseAtTheLatest) {
  WaitNotice notice(0, 3 * kNanosecondsPerSecond);
  std::vector<Nanoseconds> seconds;
  for (Nanoseconds second = 0; second < 12; ++second) {
    if (notice.is_due(second * kNanosecondsPerSecond)) seconds.push_back(second);
  }
  EXPECT_EQ(seconds, (std::vector<Nanoseconds>{2, 5, 8, 11}));
}

TEST(WaitNotice, ComesAfterTwoSecondsAndThenEverMoreRarely) {
  constexpr Nanoseconds kStart = 3600 * kNanosecondsPerSecond;
  WaitNotice notice(kStart);
  std::vector<int> due;
  for (int second = 0; second <= 250; ++second) {
    const Nanoseconds now = kStart + static_cast<Nanoseconds>(second) * kNanosecondsPerSecond;
    const bool is_time = now >= notice.next();
    EXPECT_EQ(notice.is_due(now), is_time);
    if (is_time) due.push_back(second);
  }
  EXPECT_EQ(due, (std::vector<int>{2, 6, 14, 30, 62, 122, 182, 242}));
}

}  // namespace
}  // namespace hlc::machine
