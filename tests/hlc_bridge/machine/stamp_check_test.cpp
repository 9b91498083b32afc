#include "hlc_bridge/machine/stamp_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::machine::stamp_check_test {
namespace {

using testing::ElementsAre;

constexpr Instant kNow{.run = 7 * kNanosecondsPerSecond};
constexpr Nanoseconds kAhead = 9 * kNanosecondsPerSecond;

TEST(StampCheck, CountsEachDroppedMessageAndLogsEachKindAndSenderOnce) {
  StampCheck check;
  std::vector<LogLine> lines;
  EXPECT_TRUE(check.accepts({"state", vehicle_name, 1, kNow.run}, kNow, 0, lines));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(check.accepts({"state", vehicle_name, 1, kAhead}, kNow, 0, lines));
    EXPECT_FALSE(check.accepts({"state", vehicle_name, 2, kAhead}, kNow, 0, lines));
    EXPECT_FALSE(check.accepts({"command", controller_name, 1, kAhead}, kNow, 0, lines));
  }
  EXPECT_EQ(check.dropped(), 9U);
  const std::string why = " dropped: stamp must be <= 8000000000 ns, got 9000000000 (logged once)";
  EXPECT_THAT(lines, ElementsAre(warning("state of " + vehicle_name(1) + why),
                                 warning("state of " + vehicle_name(2) + why),
                                 warning("command of high_level_controller_1" + why)));
}

}  // namespace
}  // namespace hlc::machine::stamp_check_test
