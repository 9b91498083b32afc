#include "hlc_bridge/time/real_timer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <thread>

namespace hlc {
namespace {

TEST(NextRealTick, IsTheNextPeriodWhileThatIsNotMissed) {
  EXPECT_EQ(next_real_tick(1000, 1000, 200).time, 1200U);
  EXPECT_EQ(next_real_tick(1000, 1199, 200).time, 1200U);
  EXPECT_EQ(next_real_tick(1000, 1399, 200).time, 1200U);  // late, but given
  EXPECT_EQ(next_real_tick(1000, 1399, 200).missed, 0U);
}

TEST(NextRealTick, SkipsAndCountsMissedPeriods) {
  EXPECT_EQ(next_real_tick(1000, 1400, 200).time, 1400U);
  EXPECT_EQ(next_real_tick(1000, 1400, 200).missed, 1U);
  EXPECT_EQ(next_real_tick(1000, 2199, 200).time, 2000U);
  EXPECT_EQ(next_real_tick(1000, 2199, 200).missed, 4U);
}

TEST(NextRealTick, NeverRepeatsOrGoesBackWhenTheClockDoes) {
  EXPECT_EQ(next_real_tick(1000, 10, 200).time, 1200U);
}

TEST(NextRealTick, StaysOnTheGridAndCountsEveryTickOnce) {
  const unsigned seed = 20240501;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  const Nanoseconds period = 200'000'000;
  const Nanoseconds offset = 1;
  Nanoseconds now = 1'700'000'000'123'456'789;
  Nanoseconds previous = first_real_tick(now, period, offset);
  for (int i = 0; i < 10'000; ++i) {
    now += random() % (4 * period);
    const RealTick tick = next_real_tick(previous, now, period);
    ASSERT_EQ(tick.time % period, offset);
    ASSERT_GT(tick.time, previous);
    ASSERT_EQ(tick.time - previous, (tick.missed + 1) * period);
    if (tick.missed > 0) {
      ASSERT_LT(now - tick.time, period) << "an older tick than necessary";
    }
    previous = tick.time;
  }
}

TEST(FirstRealTick, IsTheFirstOfTheGridAfterNow) {
  EXPECT_EQ(first_real_tick(0, 200, 1), 1U);
  EXPECT_EQ(first_real_tick(1, 200, 1), 201U);
  EXPECT_EQ(first_real_tick(200, 200, 1), 201U);
  EXPECT_EQ(first_real_tick(201, 200, 1), 401U);
}

TEST(RealTimer, TicksAreOnTheGridAndNeverEarly) {
  const Nanoseconds period = 1'000'000;
  RealTimer timer{period, 1};
  Nanoseconds previous = 0;
  for (int i = 0; i < 20; ++i) {
    const auto tick = timer.wait_next();
    ASSERT_TRUE(tick.has_value());
    EXPECT_GE(real_time_now(), *tick);
    EXPECT_EQ(*tick % period, 1U);
    EXPECT_GT(*tick, previous);
    previous = *tick;
  }
}

TEST(RealTimer, CountsThePeriodsThatTheCallerSlept) {
  const Nanoseconds period = 1'000'000;
  RealTimer timer{period, 0};
  const Nanoseconds first = timer.wait_next().value();
  while (real_time_now() < first + 3 * period) {
    std::this_thread::yield();
  }
  const Nanoseconds second = timer.wait_next().value();
  EXPECT_GE(timer.missed(), 2U);
  EXPECT_EQ(second - first, (timer.missed() + 1) * period);
}

TEST(RealTimer, StopWakesTheWaitingThreadAndIsFinal) {
  RealTimer timer{3'600'000'000'000, 0};  // an hour: without stop the test would time out
  std::thread stopper{[&] { timer.stop(); }};
  EXPECT_FALSE(timer.wait_next().has_value());
  stopper.join();
  EXPECT_FALSE(timer.wait_next().has_value());
}

TEST(RealTimer, RefusesAnOffsetOfAPeriod) {
  EXPECT_THROW(RealTimer(100, 100), std::invalid_argument);
  EXPECT_THROW(RealTimer(0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace hlc
