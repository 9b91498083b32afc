#pragma once

#include <mutex>
#include <utility>

namespace hlc {

/// Lets one callback at a time through, and none after close: what a callback uses can then be
/// destroyed.
class Gate {
 public:
  template <class Callback>
  void enter(Callback&& callback) {
    const std::lock_guard lock{mutex_};
    if (open_) {
      std::forward<Callback>(callback)();
    }
  }

  /// Waits for a callback that is inside.
  void close() {
    const std::lock_guard lock{mutex_};
    open_ = false;
  }

 private:
  std::mutex mutex_;
  bool open_{true};
};

}  // namespace hlc
