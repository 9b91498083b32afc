#include "hlc_bridge/process/lab_control_watch.hpp"

#include <gtest/gtest.h>

namespace hlc::lab_control_watch_test {
namespace {

using Change = LabControlWatch::Change;
using std::chrono::milliseconds;

constexpr LabControlWatch::Clock::time_point kStart{std::chrono::hours{1}};
constexpr auto kGap = LabControlWatch::kGap;
constexpr std::chrono::nanoseconds kPatience{kControllerStays};

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
  EXPECT_TRUE(watch.is_lost_for_good(kStart + kPatience + milliseconds{1}));
}

TEST(LabControlWatch, IsLostWithTheLastReaderOfStopRequests) {
  LabControlWatch watch;
  EXPECT_EQ(watch.look(false, 2, kStart), Change::kNone);
  EXPECT_EQ(watch.look(false, 1, kStart + kPatience), Change::kNone);
  const auto gone = kStart + 2 * kPatience;
  EXPECT_EQ(watch.look(false, 0, gone), Change::kNone);
  EXPECT_EQ(watch.look(false, 0, gone + kGap - milliseconds{1}), Change::kNone);
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

}  // namespace
}  // namespace hlc::lab_control_watch_test
