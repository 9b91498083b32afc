#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

namespace hlc::machine {

/// Bounds the messages that wait for the thread of a process, by publisher, so that a peer that
/// publishes faster than they are read takes neither the memory nor the place of others.
///
/// Mail is read all at once (Loop::iterate): then everyone's budget is whole again. Counted are
/// bytes, not messages, since a healthy peer may publish many small ones: a late joiner receives
/// all reports of a run.
class MailBudget {
 public:
  /// What identifies a participant of a domain.
  using Publisher = std::array<std::uint8_t, 12>;

  /// Waiting messages of one publisher. 4000 small ones: what 20 vehicles publish in seconds.
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20U;
  /// Of all publishers: those who flood may be several.
  static constexpr std::size_t kMostBytesOfAll = std::size_t{24} << 20U;
  /// A message takes at least that: each takes the place of the largest event of its machine.
  static constexpr std::size_t kBytesOfAnEvent = 1024;

  /// Whether a message of so many bytes may be posted; then it is counted.
  [[nodiscard]] bool admits(const Publisher& publisher, std::size_t bytes) {
    const std::size_t counted = bytes + kBytesOfAnEvent;
    if (all_ + counted > kMostBytesOfAll) return false;
    std::size_t& waiting = waiting_[publisher];
    if (waiting + counted > kMostBytes) return false;
    waiting += counted;
    all_ += counted;
    return true;
  }

  /// All mail is being read.
  void reset() {
    waiting_.clear();
    all_ = 0;
  }

 private:
  std::map<Publisher, std::size_t> waiting_;  ///< bytes
  std::size_t all_{};
};

}  // namespace hlc::machine
