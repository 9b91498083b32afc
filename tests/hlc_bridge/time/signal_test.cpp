#include "hlc_bridge/time/signal.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace hlc::time {
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

TEST(Signal, PostsThatDoNotFulfilTheConditionWakeNobody) {
  Signal signal;
  int count = 0;
  int looks = 0;  // of the waiting thread, guarded by the signal's lock
  const std::thread::id waiting = std::this_thread::get_id();
  std::thread poster{[&] {
    for (int i = 0; i < 1000; ++i) {
      signal.post([&] { ++count; });
      std::this_thread::yield();
    }
  }};
  EXPECT_TRUE(signal.wait_until(steady_clock::now() + 1min, [&] {
    looks += std::this_thread::get_id() == waiting ? 1 : 0;
    return count == 1000;
  }));
  poster.join();
  EXPECT_LE(looks, 10)
      << "once at the start, once at the end, and the system may wake it for nothing";
}

TEST(Signal, EveryWaitingThreadIsWokenByWhatItWaitsFor) {
  Signal signal;
  int count = 0;
  std::vector<std::thread> waiting;
  std::atomic<int> there{0};
  for (int wanted = 1; wanted <= 3; ++wanted) {
    waiting.emplace_back([&, wanted] {
      there +=
          signal.wait_until(steady_clock::now() + 1min, [&, wanted] { return count >= wanted; });
    });
  }
  for (int i = 0; i < 3; ++i) {
    signal.post([&] { ++count; });
  }
  for (std::thread& thread : waiting) {
    thread.join();
  }
  EXPECT_EQ(there, 3);
}

TEST(Signal, AConditionThatThrowsIsForgotten) {
  Signal signal;
  int looked = 0;
  const auto throwing = [&]() -> bool {
    ++looked;
    throw std::runtime_error("broken");
  };
  const auto later = std::chrono::steady_clock::now() + std::chrono::seconds{10};
  EXPECT_THROW(static_cast<void>(signal.wait_until(later, throwing)), std::runtime_error);
  signal.notify();
  EXPECT_EQ(looked, 1);
}

TEST(Signal, LockedHandsOutWhatItHolds) {
  Signal signal;
  std::vector<int> inbox;
  signal.post([&] { inbox.push_back(7); });
  EXPECT_EQ(signal.locked([&] { return std::exchange(inbox, {}); }), std::vector<int>{7});
  EXPECT_TRUE(signal.locked([&] { return inbox.empty(); }));
}

}  // namespace
}  // namespace hlc::time
