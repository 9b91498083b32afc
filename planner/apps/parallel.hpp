#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hlc::apps {

/// Runs `task(i)` for i = 0 ... count - 1 in `jobs` threads, each task once, and waits for all. If
/// tasks throw, no new ones are begun, and the exception of the smallest such i is thrown.
/// @param done  called after every task with the number of tasks done, by one thread at a time
/// @pre jobs >= 1
inline void run_parallel(std::size_t count, std::size_t jobs,
                         const std::function<void(std::size_t)>& task,
                         const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> has_failed{false};
  std::vector<std::exception_ptr> errors(count);
  std::mutex mutex;
  std::size_t num_done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !has_failed; i = next++) {
      try {
        task(i);
      } catch (...) {
        errors[i] = std::current_exception();
        has_failed = true;
      }
      const std::lock_guard lock(mutex);
      done(++num_done);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t job = 1; job < jobs; ++job) threads.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace hlc::apps
