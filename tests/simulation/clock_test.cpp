#include "hlc_bridge/messages/time_grid.hpp"
#include "vehicle_sim/closed_loop/simulated_clock.hpp"

#include <gtest/gtest.h>

#include "vehicle_sim/closed_loop/event_queue.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

TEST(SimulatedClock, ShowsTheTimeThatHasPassedAtItsOwnRate) {
  const SimulatedClock clock(10 * kNanosecondsPerSecond, 500, 20'000);  // 20 us gained in a second
  EXPECT_EQ(clock.at(10 * kNanosecondsPerSecond), 500U);
  EXPECT_EQ(clock.at(11 * kNanosecondsPerSecond), 500U + kNanosecondsPerSecond + 20'000U);
  const SimulatedClock slow(10 * kNanosecondsPerSecond, 500, -20'000);
  EXPECT_EQ(slow.at(12 * kNanosecondsPerSecond), 500U + 2 * kNanosecondsPerSecond - 40'000U);
}

TEST(SimulatedClock, SaysTheFirstTrueTimeAtWhichItShowsSomething) {
  SeededRandom random(1);
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds now = random.between(kNanosecondsPerSecond, 100 * kNanosecondsPerSecond);
    const auto drift = static_cast<std::int64_t>(random.below(4'000'000)) - 2'000'000;
    const SimulatedClock clock(now, random.between(0, 100 * kNanosecondsPerSecond), drift);
    const Nanoseconds local = clock.at(now) + random.below(10 * kNanosecondsPerSecond);
    const Nanoseconds then = clock.when(local, now);
    EXPECT_GE(clock.at(then), local);
    if (then > now) {
      EXPECT_LT(clock.at(then - 1), local);
    }
  }
}

TEST(SimulatedClock, WhatItShowsAlreadyIsNow) {
  const SimulatedClock clock(kNanosecondsPerSecond, kNanosecondsPerSecond, 0);
  EXPECT_EQ(clock.when(kNanosecondsPerSecond / 2, 3 * kNanosecondsPerSecond),
            3 * kNanosecondsPerSecond);
}

TEST(SimulatedClock, CanBeSetBackAndGoesOnFromThere) {
  SimulatedClock clock(kNanosecondsPerSecond, 5 * kNanosecondsPerSecond, 0);
  clock.step(2 * kNanosecondsPerSecond, -1'000);
  EXPECT_EQ(clock.at(2 * kNanosecondsPerSecond), 6 * kNanosecondsPerSecond - 1'000);
  clock.set_drift(3 * kNanosecondsPerSecond, 1'000'000);
  EXPECT_EQ(clock.at(4 * kNanosecondsPerSecond), 8 * kNanosecondsPerSecond - 1'000 + 1'000'000);
}

TEST(EventQueue, OfOneTimeWhatWasPlannedFirstComesFirst) {
  EventQueue queue(100);
  queue.add(300, {.what = Happening::kAlarm, .detail = 1});
  queue.add(200, {.what = Happening::kAlarm, .detail = 2});
  queue.add(300, {.what = Happening::kAlarm, .detail = 3});
  queue.add(50, {.what = Happening::kAlarm, .detail = 4});  // over: now
  EXPECT_EQ(queue.take().detail, 4U);
  EXPECT_EQ(queue.now(), 100U);
  EXPECT_EQ(queue.take().detail, 2U);
  EXPECT_EQ(queue.take().detail, 1U);
  EXPECT_EQ(queue.take().detail, 3U);
  EXPECT_EQ(queue.now(), 300U);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace hlc::closed_loop
