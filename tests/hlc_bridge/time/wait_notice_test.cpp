#include "hlc_bridge/time/wait_notice.hpp"

#include <gtest/gtest.h>

namespace hlc {
namespace {

using namespace std::chrono_literals;

TEST(WaitNotice, IsDueAfterTwoSecondsThenAfterTwiceTheTimeAndAtLeastOnceAMinute) {
  const WaitNotice::Clock::time_point begin{};
  WaitNotice notice{begin};
  EXPECT_FALSE(notice.is_due(begin + 1900ms));
  EXPECT_TRUE(notice.is_due(begin + 2s));
  EXPECT_FALSE(notice.is_due(begin + 5900ms));
  EXPECT_TRUE(notice.is_due(begin + 6s));
  WaitNotice::Clock::time_point last = begin + 6s;
  for (int i = 0; i < 10; ++i) {
    last += 60s;
    EXPECT_TRUE(notice.is_due(last)) << i;
  }
}

}  // namespace
}  // namespace hlc
