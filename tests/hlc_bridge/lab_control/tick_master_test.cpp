#include "hlc_bridge/lab_control/tick_master.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::lab_control::tick_master_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TickMaster, WaitsForTheFirstRequestOfEverybody) {
  TickMaster master{{"a", "b"}};
  master.request("a", 0);
  EXPECT_FALSE(master.releasable());
  EXPECT_THAT(master.unanswered(), ElementsAre("b"));
  master.request("b", 5);
  EXPECT_EQ(master.release(), 0U);
}

TEST(TickMaster, ReleasesTheSmallestRequestOnceEverybodyHasAnswered) {
  TickMaster master{{"a", "b"}};
  master.request("a", 0);
  master.request("b", 0);
  master.release();
  EXPECT_THAT(master.unanswered(), ElementsAre("a", "b"));
  master.request("a", 20);
  EXPECT_FALSE(master.releasable());
  master.request("b", 10);
  EXPECT_EQ(master.releasable(), 10U);
  EXPECT_EQ(master.release(), 10U);
  EXPECT_THAT(master.unanswered(), ElementsAre("b"));
}

TEST(TickMaster, RepeatedRequestIsNoAnswer) {
  TickMaster master{{"a"}};
  EXPECT_TRUE(master.request("a", 7));
  EXPECT_FALSE(master.request("a", 7));
  master.release();
  EXPECT_FALSE(master.request("a", 7));
  EXPECT_FALSE(master.releasable());
  EXPECT_TRUE(master.waits_for_released("a", 7));
  EXPECT_FALSE(master.waits_for_released("a", 6));
  EXPECT_TRUE(master.request("a", 8));
  EXPECT_FALSE(master.waits_for_released("a", 8));
}

TEST(TickMaster, DroppedTimerIsNotWaitedFor) {
  TickMaster master{{"a", "b"}};
  master.request("a", 1);
  master.request("b", 1);
  master.release();
  master.request("a", 2);
  master.drop("b");
  EXPECT_EQ(master.releasable(), 2U);
  master.drop("a");
  EXPECT_TRUE(master.empty());
  EXPECT_FALSE(master.releasable());
}

TEST(TickMaster, ForgottenTimerStartsAnew) {
  TickMaster master{{"a"}};
  master.request("a", 1);
  master.forget("a");
  EXPECT_THAT(master.unanswered(), ElementsAre("a"));
}

TEST(TickMaster, StrangersChangeNothing) {
  TickMaster master{{"a"}};
  EXPECT_FALSE(master.request("x", 1));
  EXPECT_THAT(master.unanswered(), ElementsAre("a"));
  master.request("a", 3);
  EXPECT_EQ(master.releasable(), 3U);
}

}  // namespace
}  // namespace hlc::lab_control::tick_master_test
