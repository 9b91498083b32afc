#include "vehicle_sim/closed_loop/simulated_clock.hpp"

#include <gtest/gtest.h>

#include "vehicle_sim/closed_loop/event_queue.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kTestSecond = 1'000'000'000;

TEST(SimulatedClock, ShowsTheTimeThatHasPassedAtItsOwnRate) {
  const SimulatedClock clock(10 * kTestSecond, 500, 20'000);  // 20 us gained in a second
  EXPECT_EQ(clock.at(10 * kTestSecond), 500U);
  EXPECT_EQ(clock.at(11 * kTestSecond), 500U + kTestSecond + 20'000U);
  const SimulatedClock slow(10 * kTestSecond, 500, -20'000);
  EXPECT_EQ(slow.at(12 * kTestSecond), 500U + 2 * kTestSecond - 40'000U);
}

TEST(SimulatedClock, SaysTheFirstTrueTimeAtWhichItShowsSomething) {
  SeededRandom random(1);
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds now = random.between(kTestSecond, 100 * kTestSecond);
    const auto drift = static_cast<std::int64_t>(random.below(4'000'000)) - 2'000'000;
    const SimulatedClock clock(now, random.between(0, 100 * kTestSecond), drift);
    const Nanoseconds local = clock.at(now) + random.below(10 * kTestSecond);
    const Nanoseconds then = clock.when(local, now);
    EXPECT_GE(clock.at(then), local);
    if (then > now) {
      EXPECT_LT(clock.at(then - 1), local);
    }
  }
}

TEST(SimulatedClock, WhatItShowsAlreadyIsNow) {
  const SimulatedClock clock(kTestSecond, kTestSecond, 0);
  EXPECT_EQ(clock.when(kTestSecond / 2, 3 * kTestSecond), 3 * kTestSecond);
}

TEST(SimulatedClock, CanBeSetBackAndGoesOnFromThere) {
  SimulatedClock clock(kTestSecond, 5 * kTestSecond, 0);
  clock.step(2 * kTestSecond, -1'000);
  EXPECT_EQ(clock.at(2 * kTestSecond), 6 * kTestSecond - 1'000);
  clock.set_drift(3 * kTestSecond, 1'000'000);
  EXPECT_EQ(clock.at(4 * kTestSecond), 8 * kTestSecond - 1'000 + 1'000'000);
}

TEST(EventQueue, OfOneTimeWhatWasPlannedFirstComesFirst) {
  EventQueue queue(100);
  queue.add(300, {.what = EventKind::kAlarm, .detail = 1});
  queue.add(200, {.what = EventKind::kAlarm, .detail = 2});
  queue.add(300, {.what = EventKind::kAlarm, .detail = 3});
  queue.add(50, {.what = EventKind::kAlarm, .detail = 4});  // over: now
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
