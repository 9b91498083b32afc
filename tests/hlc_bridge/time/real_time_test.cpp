#include "hlc_bridge/time/real_time.hpp"

#include <gtest/gtest.h>

namespace hlc::time {
namespace {

TEST(RealTime, PointAndNumberAreTheSameInstant) {
  const Nanoseconds now = 1'700'000'000'123'456'789;
  EXPECT_EQ(static_cast<Nanoseconds>(real_time_point(now).time_since_epoch().count()), now);
}

}  // namespace
}  // namespace hlc::time
