#include "hlc_bridge/time/signal.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace hlc {
namespace {

using std::chrono::steady_clock;
using std::chrono::system_clock;
using namespace std::chrono_literals;

TEST(Signal, WaitEndsWhenAnotherThreadPostsWhatIsWaitedFor) {
  Signal signal;
  int count = 0;
  std::thread poster{[&] {
    for (int i = 0; i < 1000; ++i) {
      signal.post([&] { ++count; });
    }
  }};
  EXPECT_TRUE(signal.wait_until(steady_clock::now() + 1min, [&] { return count == 1000; }));
  poster.join();
}

TEST(Signal, WaitEndsAtItsDeadlineWithTheConditionsLastValue) {
  Signal signal;
  EXPECT_FALSE(signal.wait_until(steady_clock::now() + 1ms, [] { return false; }));
  EXPECT_FALSE(signal.wait_until(system_clock::now() + 1ms, [] { return false; }));
  EXPECT_TRUE(signal.wait_until(steady_clock::now() - 1s, [] { return true; }));
}

TEST(Signal, NotifyMakesTheWaitingThreadLookAgain) {
  Signal signal;
  std::atomic<bool> elsewhere{false};
  std::thread notifier{[&] {
    elsewhere = true;
    signal.notify();
  }};
  EXPECT_TRUE(signal.wait_until(steady_clock::now() + 1min, [&] { return elsewhere.load(); }));
  notifier.join();
}

TEST(Signal, LockedHandsOutWhatItHolds) {
  Signal signal;
  std::vector<int> inbox;
  signal.post([&] { inbox.push_back(7); });
  EXPECT_EQ(signal.locked([&] { return std::exchange(inbox, {}); }), std::vector<int>{7});
  EXPECT_TRUE(signal.locked([&] { return inbox.empty(); }));
}

}  // namespace
}  // namespace hlc
