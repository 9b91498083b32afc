#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// How long a process goes on after the lab control is lost.
class LabControlGrace {
 public:
  explicit LabControlGrace(Nanoseconds grace) : grace_(grace) {}

  /// True once it has been lost for the grace without a break.
  /// @param is_lost  somebody bore its name, and nobody does now
  /// @param now      of any one clock; never goes back
  [[nodiscard]] bool is_over(bool is_lost, Nanoseconds now) {
    if (!is_lost) {
      lost_at_.reset();
      return false;
    }
    if (!lost_at_) lost_at_ = now;
    return now - *lost_at_ >= grace_;
  }

 private:
  Nanoseconds grace_;
  std::optional<Nanoseconds> lost_at_;
};

/// Whether the lab control, which alone can stop all cars, is lost; it may come back.
///
/// Two signs: nobody bears the name of ours (messages/node_names) any more; or stop requests, which
/// of all programs the lab control alone reads (wire contract, 4.2), have had readers and for kGap
/// have none. The latter holds for the lab's own, too, whose participant bears the name that all
/// the lab's programs have. All times are wall time.
class LabControlWatch {
 public:
  /// A reader that is made anew is no loss. (Gaps of the network that are shorter than its lease
  /// do not show here.)
  static constexpr Nanoseconds kGap = 500 * kNanosecondsPerMillisecond;

  enum class Change : std::uint8_t { kNone, kLost, kBack };

  /// @param is_name_lost          somebody bore the name, and nobody does now
  /// @param stop_request_readers  matched now
  /// @param now                   never goes back
  Change look(bool is_name_lost, std::size_t stop_request_readers, Nanoseconds now) {
    if (stop_request_readers > 0) {
      had_readers_ = true;
      without_readers_since_.reset();
    } else if (had_readers_ && !without_readers_since_) {
      without_readers_since_ = now;
    }
    const bool is_lost =
        is_name_lost || (without_readers_since_ && now >= *without_readers_since_ + kGap);
    if (is_lost == lost_at_.has_value()) return Change::kNone;
    lost_at_ = is_lost ? std::optional{now} : std::nullopt;
    return is_lost ? Change::kLost : Change::kBack;
  }

  [[nodiscard]] bool is_lost() const { return lost_at_.has_value(); }
  /// Nobody waits for it to come back any more.
  [[nodiscard]] bool is_lost_for_good(Nanoseconds now) const {
    return lost_at_ && now > *lost_at_ + kControllerStays;
  }
  /// When look or is_lost_for_good changes by time alone.
  [[nodiscard]] std::optional<Nanoseconds> wake_up() const {
    if (lost_at_) return *lost_at_ + kControllerStays + 1;
    if (without_readers_since_) return *without_readers_since_ + kGap;
    return std::nullopt;
  }

 private:
  bool had_readers_{};
  std::optional<Nanoseconds> without_readers_since_;
  std::optional<Nanoseconds> lost_at_;
};

}  // namespace hlc::machine
