#include "hlc_bridge/middleware/due_messages.hpp"

#include <gtest/gtest.h>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::middleware {
namespace {

constexpr Nanoseconds kPatience = 10'000'000'000;

TEST(DueMessages, WaitsForWhoOwesAndNoLongerThanThePatience) {
  DueMessages due{vehicle_name, kPatience};
  MiddlewareActions actions;
  due.begin(5);
  EXPECT_EQ(due.deadline(), 5 + kPatience);
  EXPECT_FALSE(due.are_in({1, 2}, 5, actions));
  EXPECT_EQ(due.awaited(), 2U);
  EXPECT_FALSE(due.are_in({2}, 4 + kPatience, actions));
  EXPECT_EQ(due.awaited(), 1U);
  EXPECT_TRUE(actions.empty());
  EXPECT_TRUE(due.are_in({2}, 5 + kPatience, actions));
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<machine::LogLine>(actions[0]),
            machine::warning("vehicle_raspberry_2: no message for 10 s; no longer waiting"));
}

TEST(DueMessages, IsInAtOnceIfNobodyOwes) {
  DueMessages due{vehicle_name, kPatience};
  MiddlewareActions actions;
  due.begin(5);
  EXPECT_TRUE(due.are_in({}, 5, actions));
  EXPECT_EQ(due.awaited(), 0U);
  EXPECT_TRUE(actions.empty());
}

TEST(DueMessages, SilentPeersAreNotWaitedForUntilTheirNextMessage) {
  DueMessages due{vehicle_name, kPatience};
  MiddlewareActions actions;
  due.begin(0);
  ASSERT_TRUE(due.are_in({1, 2}, kPatience, actions));
  due.begin(kPatience);
  EXPECT_FALSE(due.are_in({1, 2, 3}, kPatience, actions));
  EXPECT_EQ(due.awaited(), 1U);
  EXPECT_TRUE(due.are_in({1, 2}, kPatience, actions));
  due.received(2);
  EXPECT_FALSE(due.are_in({1, 2}, kPatience, actions));
  EXPECT_EQ(due.awaited(), 1U);
  EXPECT_EQ(actions.size(), 1U) << "a silent process is logged once";
}

TEST(DueMessages, PeersThatAreSilentAtFirstAreWaitedForFromTheirFirstMessageOn) {
  DueMessages due{controller_name, kPatience, {1, 2}};
  MiddlewareActions actions;
  due.begin(0);
  EXPECT_TRUE(due.are_in({1, 2}, 0, actions));
  due.received(1);
  EXPECT_FALSE(due.are_in({1, 2}, 0, actions));
}

}  // namespace
}  // namespace hlc::middleware
