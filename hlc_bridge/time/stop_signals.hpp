#pragma once

#include <functional>
#include <thread>

namespace hlc::time {

/// SIGINT and SIGTERM as a callback on a separate thread.
///
/// To be constructed first in main, before any other thread exists (participants start threads): it
/// blocks both signals, and threads inherit that. A signal that comes before on_stop is called
/// stays pending until then.
class StopSignals {
 public:
  /// Blocks SIGINT and SIGTERM in this thread and those that it starts from now on.
  StopSignals();
  /// Ends the thread, after a running callback. The signals stay blocked.
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Calls `callback(signal number)` once, at the first of the two signals. To be called at most
  /// once.
  void on_stop(std::function<void(int)> callback);

 private:
  int end_fd_;  ///< eventfd that ends the thread
  std::thread thread_;
};

}  // namespace hlc::time
