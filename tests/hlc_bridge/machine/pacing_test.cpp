#include "hlc_bridge/machine/pacing.hpp"

#include <gtest/gtest.h>

namespace hlc::machine {
namespace {

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;
constexpr Nanoseconds kWall = 1000 * kSecond;

struct LogicalPacingTest : testing::Test {
  [[nodiscard]] Instant now(Nanoseconds wall) const {
    return pacing.now({.run = 123'456, .wall = wall});
  }
  LogicalPacing pacing{60 * kSecond, kWall};
};

TEST_F(LogicalPacingTest, TimeHasNotBegunBeforeTheFirstTick) {
  EXPECT_FALSE(now(kWall).has_begun);
  EXPECT_EQ(now(kWall).run, 0U);
  EXPECT_EQ(now(kWall + 5).wall, kWall + 5);
  pacing.want(0);
  EXPECT_FALSE(pacing.is_due());
  EXPECT_TRUE(pacing.on_trigger(0, kWall));
  EXPECT_TRUE(pacing.is_due());
  EXPECT_TRUE(now(kWall).has_begun);
}

TEST_F(LogicalPacingTest, TimeStandsStillBetweenTicks) {
  pacing.want(1);
  EXPECT_TRUE(pacing.on_trigger(1, kWall));
  pacing.want(std::nullopt);
  EXPECT_EQ(now(kWall + kSecond).run, 1U);
  pacing.want(201);
  EXPECT_EQ(now(kWall + 2 * kSecond).run, 1U);
  EXPECT_TRUE(pacing.on_trigger(201, kWall));
  EXPECT_EQ(now(kWall + 2 * kSecond).run, 201U);
}

TEST_F(LogicalPacingTest, SaysWhichTickIsWantedUntilItIsReleased) {
  EXPECT_EQ(pacing.announcement(kWall), std::nullopt) << "no tick is wanted";
  EXPECT_EQ(pacing.wake_up().wall, std::nullopt);
  pacing.want(200);
  EXPECT_EQ(pacing.announcement(kWall), 200U);
  EXPECT_EQ(pacing.announcement(kWall + 1), std::nullopt);
  pacing.want(200);
  EXPECT_EQ(pacing.announcement(kWall + 1), std::nullopt) << "the same tick still";
  EXPECT_EQ(pacing.wake_up().wall, kWall + kSecond);
  EXPECT_EQ(pacing.announcement(kWall + kSecond), 200U);
  pacing.on_trigger(200, kWall + kSecond);
  EXPECT_EQ(pacing.announcement(kWall + 2 * kSecond), std::nullopt);
  pacing.want(400);
  EXPECT_EQ(pacing.announcement(kWall + kSecond + 1), 400U) << "the next one at once";
}

TEST_F(LogicalPacingTest, TriggersForOtherTimesHaveNoEffect) {
  EXPECT_FALSE(pacing.on_trigger(0, kWall)) << "no tick is wanted";
  pacing.want(200);
  for (const Nanoseconds other :
       {Nanoseconds{201}, Nanoseconds{220}, Nanoseconds{400}, Nanoseconds{17}, kStopSymbol}) {
    EXPECT_FALSE(pacing.on_trigger(other, kWall));
    EXPECT_FALSE(pacing.is_due());
  }
  EXPECT_FALSE(now(kWall).has_begun);
}

TEST_F(LogicalPacingTest, ATriggerGivesOneTickOnly) {
  pacing.want(0);
  EXPECT_TRUE(pacing.on_trigger(0, kWall));
  EXPECT_TRUE(pacing.on_trigger(0, kWall));
  pacing.want(20);
  EXPECT_FALSE(pacing.is_due());
}

TEST_F(LogicalPacingTest, GivesUpWhenNoTriggerComesThoughATickIsWanted) {
  EXPECT_FALSE(pacing.is_timed_out(kWall + 1000 * kSecond));
  pacing.want(0);
  EXPECT_FALSE(pacing.is_timed_out(kWall + 60 * kSecond - 1));
  EXPECT_TRUE(pacing.is_timed_out(kWall + 60 * kSecond));
  pacing.on_trigger(17, kWall + 59 * kSecond);  // for another vehicle: the lab control is alive
  EXPECT_FALSE(pacing.is_timed_out(kWall + 100 * kSecond));
  EXPECT_TRUE(pacing.is_timed_out(kWall + 119 * kSecond));
  EXPECT_FALSE(pacing.is_timed_out(kWall)) << "a reading from before the trigger";
}

TEST(LogicalPacing, HasMorePatienceWithALongStart) {
  EXPECT_EQ(LogicalPacing::patience_for(20 * kSecond), 60 * kSecond);
  EXPECT_EQ(LogicalPacing::patience_for(90 * kSecond), 120 * kSecond);
}

// --- in the lab ----------------------------------------------------------------------------------

struct LogicalPacingInTheLab : testing::Test {
  LogicalPacing pacing{60 * kSecond, kWall, LogicalStart::kInTheLab};
  const Nanoseconds listened_until = kWall + LogicalPacing::kListen;
};

TEST_F(LogicalPacingInTheLab, TheOperatorMayStartTheRunAnHourLater) {
  pacing.want(0);
  EXPECT_FALSE(pacing.is_timed_out(kWall + 3600 * kSecond));
  pacing.on_trigger(0, kWall + 3600 * kSecond);
  pacing.want(20);
  pacing.on_trigger(20, kWall + 3601 * kSecond);
  pacing.want(40);
  EXPECT_FALSE(pacing.is_timed_out(kWall + 3660 * kSecond));
  EXPECT_TRUE(pacing.is_timed_out(kWall + 3661 * kSecond)) << "once it runs it must not pause";
}

TEST_F(LogicalPacingInTheLab, ListensBeforeItAnnouncesItsFirstTick) {
  pacing.want(0);
  EXPECT_EQ(pacing.announcement(kWall), std::nullopt);
  EXPECT_EQ(pacing.wake_up().wall, listened_until);
  EXPECT_EQ(pacing.announcement(listened_until), 0U);
  pacing.on_trigger(0, listened_until);
  pacing.want(20);
  EXPECT_EQ(pacing.announcement(listened_until + 1), 20U) << "the later ones at once";
}

TEST_F(LogicalPacingInTheLab, ListensToTheEndAlsoIfItsWishChanges) {
  pacing.want(1);
  EXPECT_EQ(pacing.announcement(kWall), std::nullopt);
  pacing.want(20);
  EXPECT_EQ(pacing.announcement(kWall + 1), std::nullopt);
  EXPECT_EQ(pacing.wake_up().wall, listened_until);
  EXPECT_EQ(pacing.announcement(listened_until), 20U);
}

TEST_F(LogicalPacingInTheLab, ATriggerOfTimeZeroIsTheBeginOfTheRun) {
  pacing.want(0);
  pacing.on_trigger(0, kWall);
  pacing.want(20);
  EXPECT_TRUE(pacing.is_timed_out(kWall + 60 * kSecond));
}

TEST_F(LogicalPacingInTheLab, ATickThatTimeHasPassedIsDueInsteadOfAnnounced) {
  pacing.want(1);
  EXPECT_EQ(pacing.announcement(kWall), std::nullopt);
  EXPECT_TRUE(pacing.on_trigger(7 * kSecond, kWall + 1)) << "of a vehicle, in a run under way";
  EXPECT_TRUE(pacing.is_due());
  EXPECT_EQ(pacing.announcement(listened_until), std::nullopt);
  EXPECT_EQ(pacing.now({.run = 0, .wall = listened_until}).run, 7 * kSecond);
  pacing.want(7 * kSecond + 1);
  EXPECT_FALSE(pacing.is_due());
  EXPECT_EQ(pacing.announcement(listened_until), 7 * kSecond + 1);
}

TEST_F(LogicalPacingInTheLab, ATriggerFromBeforeTheWishCountsToo) {
  EXPECT_FALSE(pacing.on_trigger(7 * kSecond, kWall));
  pacing.want(1);
  EXPECT_TRUE(pacing.is_due());
}

TEST_F(LogicalPacingInTheLab, TheStopSymbolIsNoTime) {
  pacing.want(1);
  EXPECT_FALSE(pacing.on_trigger(kStopSymbol, kWall));
  EXPECT_FALSE(pacing.is_due());
}

TEST(RealPacing, TimeIsThatOfTheClock) {
  RealPacing pacing;
  const Instant now = pacing.now({.run = 5, .wall = 7});
  EXPECT_EQ(now.run, 5U);
  EXPECT_EQ(now.wall, 7U);
  EXPECT_TRUE(now.has_begun);
  EXPECT_EQ(pacing.wake_up().run, std::nullopt);
  pacing.want(200);
  EXPECT_EQ(pacing.wake_up().run, 200U);
  EXPECT_FALSE(pacing.on_trigger(200, 7));
  EXPECT_FALSE(pacing.is_due());
  EXPECT_EQ(pacing.announcement(7), std::nullopt);
  EXPECT_FALSE(pacing.is_timed_out(~Nanoseconds{0}));
}

}  // namespace
}  // namespace hlc::machine
