#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace hlc::test {

/// A quarter of the lease: a silence of this length has no consequences yet, and a busy
/// machine lets a thread that sleeps most of the time wait far less.
inline constexpr std::chrono::milliseconds kStandstill{500};

/// For how long at most this process did not run although it wanted to.
class StandstillWatch {
 public:
  StandstillWatch() : thread_([this] { watch(); }) {}
  StandstillWatch(const StandstillWatch&) = delete;
  StandstillWatch& operator=(const StandstillWatch&) = delete;
  ~StandstillWatch() { (void)end(); }

  /// Ends the watch; how long it was.
  std::chrono::steady_clock::duration end() {
    {
      const std::lock_guard lock{mutex_};
      stop_ = true;
    }
    stopped_.notify_all();
    if (thread_.joinable()) thread_.join();
    return longest_;
  }

 private:
  void watch() {
    constexpr std::chrono::milliseconds kNap{20};
    std::unique_lock lock{mutex_};
    while (!stop_) {
      const std::chrono::steady_clock::time_point wake = std::chrono::steady_clock::now() + kNap;
      stopped_.wait_until(lock, wake, [this] { return stop_; });
      longest_ = std::max(longest_, std::chrono::steady_clock::now() - wake);
    }
  }

  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_{};
  std::chrono::steady_clock::duration longest_{};
  std::thread thread_;  // last: uses the others
};

}  // namespace hlc::test
