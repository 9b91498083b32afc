#include "hlc_bridge/messages/validate.hpp"

#include <gtest/gtest.h>

namespace hlc::validate_test {
namespace {

constexpr Nanoseconds kPeriod = 200 * kNanosecondsPerMillisecond;
constexpr Nanoseconds kLast = ~Nanoseconds{};

TEST(PlausibleStamp, LiesAtMostASecondAndAPeriodAhead) {
  const Instant now{.run = 5 * kNanosecondsPerSecond};
  for (const Nanoseconds stamp : {Nanoseconds{0}, now.run, now.run + kMostLead + kPeriod}) {
    EXPECT_TRUE(is_plausible_stamp(stamp, now, kPeriod)) << stamp;
  }
  for (const Nanoseconds stamp : {now.run + kMostLead + kPeriod + 1, kLast}) {
    EXPECT_FALSE(is_plausible_stamp(stamp, now, kPeriod)) << stamp;
  }
}

TEST(PlausibleStamp, IsAnyBeforeTheFirstTickOfLogicalTime) {
  EXPECT_TRUE(is_plausible_stamp(kLast, {.has_begun = false}, kPeriod));
  EXPECT_FALSE(is_plausible_stamp(kLast, {.has_begun = true}, kPeriod));
}

}  // namespace
}  // namespace hlc::validate_test
