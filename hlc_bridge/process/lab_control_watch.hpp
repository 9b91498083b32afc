#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc {

/// Whether the lab control, which alone can stop all cars, is lost; it may come back.
///
/// Two signs: nobody bears the name of ours (messages/node_names) any more; or stop requests, which
/// of all programs the lab control alone reads (wire contract, 4.2), have had readers and for kGap
/// have none. The latter holds for the lab's own, too, whose participant bears the name that all
/// the lab's programs have.
class LabControlWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// A reader that is made anew is no loss. (Gaps of the network that are shorter than its lease
  /// do not show here.)
  static constexpr std::chrono::milliseconds kGap{500};

  enum class Change : std::uint8_t { kNone, kLost, kBack };

  /// @param is_name_lost          somebody bore the name, and nobody does now
  /// @param stop_request_readers  matched now
  /// @param now                   never goes back
  Change look(bool is_name_lost, std::size_t stop_request_readers, Clock::time_point now) {
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
  [[nodiscard]] bool is_lost_for_good(Clock::time_point now) const {
    return lost_at_ && now > *lost_at_ + std::chrono::nanoseconds(kControllerStays);
  }

 private:
  bool had_readers_{};
  std::optional<Clock::time_point> without_readers_since_;
  std::optional<Clock::time_point> lost_at_;
};

}  // namespace hlc
