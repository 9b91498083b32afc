#pragma once

#include <mutex>
#include <utility>

namespace hlc::dds {

/// Admits one callback at a time, and none after close: the objects that a callback uses can then
/// be destroyed.
class Gate {
 public:
  template <class Callback>
  void enter(Callback&& callback) {
    const std::lock_guard lock{mutex_};
    if (open_) {
      std::forward<Callback>(callback)();
    }
  }

  /// Waits for a running callback.
  void close() {
    const std::lock_guard lock{mutex_};
    open_ = false;
  }

 private:
  std::mutex mutex_;
  bool open_{true};
};

}  // namespace hlc::dds
