#include "hlc_bridge/time/logical_timer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace hlc {
namespace {

using namespace std::chrono_literals;

constexpr Nanoseconds kPeriod = 200;

TEST(LogicalTimer, GivesTheTicksThatAreTriggeredFromTheOffsetOn) {
  std::vector<Nanoseconds> wanted;
  LogicalTimer* master = nullptr;
  LogicalTimer timer{kPeriod, 1, [&](Nanoseconds t) {
                       wanted.push_back(t);
                       master->on_trigger(t);
                     }};
  master = &timer;
  for (const Nanoseconds expected : {1U, 201U, 401U}) {
    EXPECT_EQ(timer.wait_next(), expected);
  }
  EXPECT_EQ(wanted, (std::vector<Nanoseconds>{1, 201, 401}));
}

TEST(LogicalTimer, TriggersForOtherTimesHaveNoEffect) {
  LogicalTimer* master = nullptr;
  int asked = 0;
  LogicalTimer timer{
      kPeriod, 0,
      [&](Nanoseconds t) {
        for (const Nanoseconds other : {t + 1, t + 20, t + kPeriod, Nanoseconds{17}}) {
          master->on_trigger(other);
        }
        if (++asked == 3) {
          master->on_trigger(t);
        }
      },
      1ms};
  master = &timer;
  EXPECT_EQ(timer.wait_next(), 0U);
  EXPECT_EQ(asked, 3) << "a trigger for another time released the tick";
}

TEST(LogicalTimer, RepeatsTheReadyStatusUntilTheTriggerComes) {
  LogicalTimer* master = nullptr;
  std::vector<Nanoseconds> wanted;
  LogicalTimer timer{kPeriod, 0,
                     [&](Nanoseconds t) {
                       wanted.push_back(t);
                       if (wanted.size() == 5) {
                         master->on_trigger(t);
                       }
                     },
                     1ms};
  master = &timer;
  EXPECT_EQ(timer.wait_next(), 0U);
  EXPECT_EQ(wanted, std::vector<Nanoseconds>(5, 0U));
}

TEST(LogicalTimer, ATriggerGivesOneTickOnly) {
  LogicalTimer* master = nullptr;
  std::atomic<int> asked{0};
  LogicalTimer timer{kPeriod, 0,
                     [&](Nanoseconds t) {
                       ++asked;
                       if (t == 0) {
                         master->on_trigger(0);
                         master->on_trigger(0);
                       } else if (asked == 4) {
                         master->stop();
                       }
                     },
                     1ms};
  master = &timer;
  EXPECT_EQ(timer.wait_next(), 0U);
  EXPECT_FALSE(timer.wait_next().has_value());
  EXPECT_EQ(asked, 4);
}

TEST(LogicalTimer, StopSymbolEndsItForGood) {
  LogicalTimer* master = nullptr;
  LogicalTimer timer{kPeriod, 0, [&](Nanoseconds) { master->on_trigger(kStopSymbol); }};
  master = &timer;
  EXPECT_FALSE(timer.wait_next().has_value());
  timer.on_trigger(0);
  EXPECT_FALSE(timer.wait_next().has_value());
}

TEST(LogicalTimer, StopWakesTheWaitingThread) {
  LogicalTimer timer{kPeriod, 0, [](Nanoseconds) {}, std::chrono::hours{1}};
  std::thread stopper{[&] { timer.stop(); }};
  EXPECT_FALSE(timer.wait_next().has_value());
  stopper.join();
}

TEST(LogicalTimer, GivesUpWhenNoTriggerComes) {
  int asked = 0;
  LogicalTimer* self = nullptr;
  LogicalTimer timer{kPeriod, 0,
                     [&](Nanoseconds) {
                       if (++asked == 1000) self->stop();  // only a timer that waits forever
                     },
                     1ms, 10ms};
  self = &timer;
  EXPECT_FALSE(timer.wait_next().has_value());
  EXPECT_TRUE(timer.has_given_up());
  timer.on_trigger(0);
  EXPECT_FALSE(timer.wait_next().has_value());
}

TEST(LogicalTimer, ATimerThatIsStoppedHasNotGivenUp) {
  LogicalTimer timer{kPeriod, 0, [](Nanoseconds) {}};
  timer.stop();
  EXPECT_FALSE(timer.wait_next().has_value());
  EXPECT_FALSE(timer.has_given_up());
}

TEST(LogicalTimer, TwoTimersAndAMasterKeepOneOrder) {
  // The smallest wanted time is released until both want a later one: what lab control does.
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Nanoseconds> wanted(2);
  std::vector<bool> reported(2);
  std::vector<Nanoseconds> order;
  const auto ready = [&](std::size_t who) {
    return [&, who](Nanoseconds t) {
      const std::lock_guard lock{mutex};
      wanted[who] = t;
      reported[who] = true;
      changed.notify_all();
    };
  };
  LogicalTimer vehicle{20, 0, ready(0)};
  LogicalTimer middleware{200, 1, ready(1)};
  const auto run = [&](LogicalTimer& timer) {
    while (const auto tick = timer.wait_next()) {
      const std::lock_guard lock{mutex};
      order.push_back(*tick);
    }
  };
  std::thread vehicle_thread{[&] { run(vehicle); }};
  std::thread middleware_thread{[&] { run(middleware); }};
  for (Nanoseconds released = 0; released < 1000;) {
    std::unique_lock lock{mutex};
    ASSERT_TRUE(changed.wait_for(lock, 1min, [&] { return reported[0] && reported[1]; }));
    released = std::min(wanted[0], wanted[1]);
    for (std::size_t who = 0; who < 2; ++who) {
      reported[who] = wanted[who] != released;
    }
    lock.unlock();
    vehicle.on_trigger(released);
    middleware.on_trigger(released);
  }
  vehicle.stop();
  middleware.stop();
  vehicle_thread.join();
  middleware_thread.join();
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  EXPECT_GE(order.size(), 50U);
}

TEST(LogicalTimer, RefusesAnOffsetOfAPeriod) {
  EXPECT_THROW(LogicalTimer(100, 100, [](Nanoseconds) {}), std::invalid_argument);
}

}  // namespace
}  // namespace hlc
