#include "hlc_bridge/time/stop_signals.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "hlc_bridge/time/signal.hpp"

namespace hlc::time {
namespace {

using namespace std::chrono_literals;

class StopSignalsTest : public testing::Test {
 protected:
  void record(int number) {
    signal_.post([&] { received_.push_back(number); });
  }
  [[nodiscard]] bool wait_for_one() {
    return signal_.wait_until(std::chrono::steady_clock::now() + 1min,
                              [&] { return !received_.empty(); });
  }

  Signal signal_;
  std::vector<int> received_;
};

TEST_F(StopSignalsTest, CallsBackWithTheSignal) {
  for (const int number : {SIGINT, SIGTERM}) {
    received_.clear();
    StopSignals stop;
    stop.on_stop([&](int received) { record(received); });
    kill(getpid(), number);
    ASSERT_TRUE(wait_for_one());
    EXPECT_EQ(received_, std::vector<int>{number});
  }
}

TEST_F(StopSignalsTest, ASignalBeforeTheCallbackIsKeptForIt) {
  StopSignals stop;
  kill(getpid(), SIGTERM);
  stop.on_stop([&](int received) { record(received); });
  ASSERT_TRUE(wait_for_one());
  EXPECT_EQ(received_, std::vector<int>{SIGTERM});
}

TEST_F(StopSignalsTest, EndsWithoutASignal) {
  {
    StopSignals stop;
    stop.on_stop([&](int received) { record(received); });
  }
  { StopSignals never_used; }
  EXPECT_TRUE(received_.empty());
}

TEST_F(StopSignalsTest, ThreadsStartedAfterwardsInheritTheBlock) {
  StopSignals stop;
  sigset_t blocked;
  std::thread thread{[&] { pthread_sigmask(SIG_BLOCK, nullptr, &blocked); }};
  thread.join();
  EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
  EXPECT_EQ(sigismember(&blocked, SIGTERM), 1);
}

}  // namespace
}  // namespace hlc::time
