#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace hlc::time {

/// The one place where a process's control thread waits. Callbacks of other threads (messages,
/// matches, presence, signals) store their data under the signal's lock; the control thread waits
/// until its condition holds, or until a deadline.
///
///     Signal signal;
///     std::vector<TrajectoryCommand> inbox;  // guarded by signal
///     Reader<TrajectoryCommand> reader{participant, topic, [&](const TrajectoryCommand& c) {
///       signal.post([&] { inbox.push_back(c); });
///     }};
///     bool there = signal.wait_until(deadline, [&] { return !inbox.empty(); });
///     auto commands = signal.locked([&] { return std::exchange(inbox, {}); });
///
/// Rules: nothing blocks while the lock is held - no write to a topic, no creation or destruction
/// of an endpoint or participant. Queries of Participant, Writer and Reader (alive, matched ...)
/// are permitted.
///
/// Conditions are evaluated under the lock, and also on the posting threads, while their own thread
/// waits. So they are pure (they read, and change nothing), read only data guarded by the lock,
/// written by the waiting thread alone, or self-guarded, and do not throw.
class Signal {
 public:
  /// Runs `change` under the lock, then wakes the waiting threads if one of their conditions holds.
  /// The conditions are evaluated here, on the posting thread: in logical time most messages bring
  /// only a part of what a process waits for, and waking it for each would slow down the run
  /// considerably.
  template <class Change>
  void post(Change&& change) {
    {
      const std::lock_guard lock{mutex_};
      std::forward<Change>(change)();
      if (std::ranges::none_of(waiting_, [](const auto* holds) { return (*holds)(); })) {
        return;
      }
    }
    changed_.notify_all();
  }

  /// Evaluates the conditions again: for changes of state that is guarded elsewhere.
  void notify() {
    post([] {});
  }

  /// Runs `access` under the lock and returns its result.
  template <class Access>
  decltype(auto) locked(Access&& access) const {
    const std::lock_guard lock{mutex_};
    return std::forward<Access>(access)();
  }

  /// Waits until `condition` (evaluated under the lock) holds, at most until `deadline`; returns
  /// the condition's last value.
  template <class TimePoint, class Condition>
  [[nodiscard]] bool wait_until(const TimePoint& deadline, Condition&& condition) const {
    const std::function<bool()> holds{std::ref(condition)};
    std::unique_lock lock{mutex_};
    const Entry entry{waiting_, &holds};  // destroyed before the lock
    return changed_.wait_until(lock, deadline, holds);
  }

  /// Calls `act` (with no lock held) at once and then every `interval` until `condition` holds, at
  /// most until `deadline`; returns the condition's last value. For requests whose answer can be
  /// lost.
  template <class Condition, class Act>
  [[nodiscard]] bool repeat_until(std::chrono::steady_clock::time_point deadline,
                                  std::chrono::milliseconds interval, Condition&& condition,
                                  Act&& act) const {
    while (!wait_until(std::chrono::steady_clock::now(), condition)) {
      const auto now = std::chrono::steady_clock::now();
      if (now >= deadline) return false;
      act();
      if (wait_until(std::min(deadline, now + interval), condition)) return true;
    }
    return true;
  }

 private:
  using Conditions = std::vector<const std::function<bool()>*>;

  /// Registers a condition for evaluation, for its own lifetime. Under the lock.
  class Entry {
   public:
    Entry(Conditions& conditions, const std::function<bool()>* condition)
        : conditions_{conditions}, condition_{condition} {
      conditions_.push_back(condition_);
    }
    ~Entry() { std::erase(conditions_, condition_); }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    Conditions& conditions_;
    const std::function<bool()>* condition_;
  };

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable Conditions waiting_;  ///< of waiting threads
};

}  // namespace hlc::time
