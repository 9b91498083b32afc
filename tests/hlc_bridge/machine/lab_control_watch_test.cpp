#include "hlc_bridge/machine/lab_control_watch.hpp"

#include <gtest/gtest.h>

namespace hlc::machine {
namespace {

using Change = LabControlWatch::Change;

constexpr Nanoseconds kStart = 3600 * kNanosecondsPerSecond;
constexpr auto kGap = LabControlWatch::kGap;
constexpr Nanoseconds kPatience = kControllerStays;

TEST(LabControlWatch, WhoWasNeverThereIsNotLost) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(false, 0, kStart), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, kStart + 2 * kPatience), Change::kNone);
  EXPECT_FALSE(watch.is_lost());
  EXPECT_FALSE(watch.is_lost_for_good(kStart + 4 * kPatience));
}

TEST(LabControlWatch, IsLostWithItsName) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(true, 0, kStart), Change::kLost);
  EXPECT_TRUE(watch.is_lost());
  EXPECT_EQ(watch.look(true, 0, kStart + kPatience), Change::kNone);
  EXPECT_FALSE(watch.is_lost_for_good(kStart + kPatience));
  EXPECT_TRUE(watch.is_lost_for_good(kStart + kPatience + kNanosecondsPerMillisecond));
}

TEST(LabControlWatch, IsLostWithTheLastReaderOfStopRequests) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(false, 2, kStart), Change::kNone);
  EXPECT_EQ(watch.look(false, 1, kStart + kPatience), Change::kNone);
  const auto gone = kStart + 2 * kPatience;
  EXPECT_EQ(watch.look(false, 0, gone), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, gone + kGap - kNanosecondsPerMillisecond), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, gone + kGap), Change::kLost);
}

TEST(LabControlWatch, AReaderThatIsMadeAnewIsNoLoss) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(false, 1, kStart), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, kStart + kPatience), Change::kNone);
  EXPECT_EQ(watch.look(false, 1, kStart + kPatience + kGap / 2), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, kStart + kPatience + kGap), Change::kNone);
  EXPECT_FALSE(watch.is_lost());
}

TEST(LabControlWatch, WhoIsBackIsWaitedForAnewTheNextTime) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(true, 0, kStart), Change::kLost);
  const auto back = kStart + kPatience / 2;
  EXPECT_EQ(watch.look(false, 1, back), Change::kBack);
  EXPECT_FALSE(watch.is_lost());
  EXPECT_FALSE(watch.is_lost_for_good(back + kPatience));
  const auto again = back + 10 * kPatience;
  EXPECT_EQ(watch.look(true, 0, again), Change::kLost);
  EXPECT_FALSE(watch.is_lost_for_good(again + kPatience));
}

TEST(LabControlWatch, WakesUpWhenTimeAloneChangesIt) {
  LabControlWatch watch;
  EXPECT_EQ(watch.wake_up(), std::nullopt);
  static_cast<void>(watch.look(false, 1, kStart));
  static_cast<void>(watch.look(false, 0, kStart));
  ASSERT_EQ(watch.wake_up(), kStart + kGap);
  EXPECT_EQ(watch.look(false, 0, *watch.wake_up()), Change::kLost);
  EXPECT_TRUE(watch.is_lost_for_good(watch.wake_up().value()));
}

TEST(LabControlWatch, IsLostOnceThreeRequestsInARowAreUnansweredAndBackWithAnAnswer) {
  LabControlWatch watch;
  ASSERT_TRUE(watch.request_is_due(kStart));
  watch.receive_answer();
  EXPECT_FALSE(watch.request_is_due(kStart + LabControlWatch::kRequestInterval - 1));
  Nanoseconds now = kStart;
  for (int i = 0; i < 10 && watch.look(false, 1, now) == Change::kNone; ++i) {
    now = watch.next_request();
    static_cast<void>(watch.request_is_due(now));
  }
  EXPECT_TRUE(watch.is_lost());
  EXPECT_EQ(now, kStart + 3 * LabControlWatch::kRequestInterval + LabControlWatch::kAnswerTime);
  ASSERT_TRUE(watch.request_is_due(watch.next_request()));
  EXPECT_EQ(watch.look(false, 1, now + kNanosecondsPerSecond), Change::kNone) << "still lost";
  watch.receive_answer();
  EXPECT_EQ(watch.look(false, 1, now + kNanosecondsPerSecond), Change::kBack);
}

TEST(LabControlWatch, OneThatHasNeverAnsweredIsNotLostForThat) {
  LabControlWatch watch;
  Nanoseconds now = kStart;
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(watch.request_is_due(now));
    EXPECT_EQ(watch.look(false, 1, now), Change::kNone);
    now = watch.next_request();
  }
}

TEST(LabControlGrace, IsOverOnceTheLabControlIsLostForAllOfIt) {
  LabControlGrace grace(100);
  EXPECT_FALSE(grace.is_over(true, 1000));
  EXPECT_FALSE(grace.is_over(false, 1050));
  EXPECT_FALSE(grace.is_over(true, 1060));
  EXPECT_FALSE(grace.is_over(true, 1159));
  EXPECT_TRUE(grace.is_over(true, 1160));
}

TEST(LabControlGrace, OfNothingIsOverAtOnce) {
  LabControlGrace grace(0);
  EXPECT_FALSE(grace.is_over(false, 5));
  EXPECT_TRUE(grace.is_over(true, 5));
}

}  // namespace
}  // namespace hlc::machine
