#include "hlc_bridge/time/real_time.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace hlc::time {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kHour = 3600 * kSecond;

Nanoseconds steady_ns = 0;
Nanoseconds system_ns = 0;
int calls_until_interrupted = -1;

Nanoseconds steady() { return steady_ns; }
/// The reading thread can be interrupted for a second.
Nanoseconds system() {
  if (calls_until_interrupted-- == 0) {
    steady_ns += kSecond;
    system_ns += kSecond;
  }
  return system_ns;
}

class SteadyRealTimeTest : public testing::Test {
 protected:
  SteadyRealTimeTest() {
    steady_ns = 5 * kSecond;
    system_ns = 1'700'000'000 * kSecond;
    calls_until_interrupted = -1;
  }
  static void pass(std::int64_t time) {
    steady_ns += static_cast<Nanoseconds>(time);
    system_ns += static_cast<Nanoseconds>(time);
  }
};

TEST_F(SteadyRealTimeTest, GoesOnAsTheSystemsClockWhileThatIsNotSet) {
  const SteadyRealTime clock{system, steady};
  for (int i = 0; i < 3; ++i, pass(kHour)) {
    EXPECT_EQ(clock.at(steady_ns), system_ns);
    EXPECT_EQ(clock.system_step(), 0);
  }
}

TEST_F(SteadyRealTimeTest, GoesOnSteadilyWhenTheSystemsClockIsSet) {
  for (const std::int64_t step : {-kHour, -kSecond / 100, kSecond / 100, kHour}) {
    const SteadyRealTime clock{system, steady};
    const Nanoseconds before = clock.at(steady_ns);
    system_ns += static_cast<Nanoseconds>(step);
    pass(kSecond);
    EXPECT_EQ(clock.at(steady_ns) - before, static_cast<Nanoseconds>(kSecond));
    EXPECT_EQ(clock.system_step(), step);
  }
}

TEST_F(SteadyRealTimeTest, TakesNoInterruptionOfTheReadingThreadForAStep) {
  const SteadyRealTime clock{system, steady};
  for (calls_until_interrupted = 0; calls_until_interrupted < 5;) {
    const int next = calls_until_interrupted + 1;
    EXPECT_EQ(clock.system_step(), 0) << next - 1;
    calls_until_interrupted = next;
  }
  calls_until_interrupted = 2;
  EXPECT_EQ(SteadyRealTime(system, steady).at(steady_ns), system_ns);
}

TEST(RealTime, IsTheSystemsWhereThatIsNotSet) {
  const auto system_now = std::chrono::system_clock::now().time_since_epoch();
  const auto difference = std::chrono::nanoseconds{real_time_now()} - system_now;
  EXPECT_LT(std::chrono::abs(difference), std::chrono::minutes{1});
}

TEST(SystemClockWatch, NoticesEachStepOnceFromTheLeastOneOn) {
  constexpr std::int64_t kStep = SystemClockWatch::kLeastStep;
  SystemClockWatch watch;
  EXPECT_EQ(watch.new_step(kStep - 1), std::nullopt);
  EXPECT_EQ(watch.new_step(kStep), kStep);
  EXPECT_EQ(watch.new_step(kStep), std::nullopt);
  EXPECT_EQ(watch.new_step(kStep - kHour), -kHour);
  EXPECT_EQ(watch.new_step(0), kHour - kStep) << "set right again";
}

}  // namespace
}  // namespace hlc::time
