#include "hlc_bridge/machine/ticks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace hlc::machine {
namespace {

constexpr Nanoseconds kPeriod = 200;

Instant at(Nanoseconds run) { return {.run = run, .wall = 7}; }

TEST(Ticks, TheFirstIsTheFirstOfTheGridFromNowOn) {
  EXPECT_EQ(Ticks(kPeriod, 1, at(0)).next(), 1U);
  EXPECT_EQ(Ticks(kPeriod, 1, at(1)).next(), 1U);
  EXPECT_EQ(Ticks(kPeriod, 1, at(2)).next(), 201U);
  EXPECT_EQ(Ticks(kPeriod, 0, at(400)).next(), 400U);
}

TEST(Ticks, NoneIsGivenBeforeItsTimeAndEachOnce) {
  Ticks ticks(kPeriod, 1, at(1000));
  EXPECT_EQ(ticks.take(at(1000)), std::nullopt);
  EXPECT_EQ(ticks.take(at(1001)), 1001U);
  EXPECT_EQ(ticks.take(at(1001)), std::nullopt);
  EXPECT_EQ(ticks.next(), 1201U);
}

TEST(Ticks, TheTickOfTimeZeroWaitsUntilTimeHasBegun) {
  Ticks ticks(kPeriod, 0, {.has_begun = false});
  EXPECT_EQ(ticks.next(), 0U);
  EXPECT_EQ(ticks.take({.wall = 5, .has_begun = false}), std::nullopt);
  EXPECT_EQ(ticks.take(at(0)), 0U);
}

TEST(Ticks, LateByLessThanAPeriodIsGivenLateAndOlderOnesAreSkipped) {
  Ticks ticks(kPeriod, 0, at(1000));
  EXPECT_EQ(ticks.take(at(1199)), 1000U);
  EXPECT_EQ(ticks.missed(), 0U);
  EXPECT_EQ(ticks.take(at(2199)), 2000U);
  EXPECT_EQ(ticks.missed(), 4U);
}

TEST(Ticks, NeverRepeatOrGoBackWhenTheClockDoes) {
  Ticks ticks(kPeriod, 0, at(1000));
  EXPECT_EQ(ticks.take(at(1000)), 1000U);
  EXPECT_EQ(ticks.take(at(10)), std::nullopt);
  EXPECT_EQ(ticks.take(at(1200)), 1200U);
}

TEST(Ticks, StayOnTheGridAndCountEveryTickOnce) {
  const unsigned seed = 20240501;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  const Nanoseconds period = 200'000'000;
  Nanoseconds now = 1'700'000'000'123'456'789;
  Ticks ticks(period, 1, at(now));
  Nanoseconds previous = ticks.next() - period;
  for (int i = 0; i < 10'000; ++i) {
    now += random() % (4 * period);
    const std::uint64_t missed_before = ticks.missed();
    const auto tick = ticks.take(at(now));
    ASSERT_EQ(tick.has_value(), now >= previous + period);
    if (!tick) continue;
    ASSERT_EQ(*tick % period, 1U);
    ASSERT_EQ(*tick - previous, (ticks.missed() - missed_before + 1) * period);
    ASSERT_LT(now - *tick, period) << "an older tick than necessary";
    previous = *tick;
  }
}

TEST(Ticks, RefuseAnOffsetOfAPeriod) {
  EXPECT_THROW(Ticks(100, 100, at(0)), std::invalid_argument);
  EXPECT_THROW(Ticks(0, 0, at(0)), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::machine
