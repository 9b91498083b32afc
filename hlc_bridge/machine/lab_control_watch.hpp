#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::machine {

/// How long a process continues after the lab control is lost.
class LabControlGrace {
 public:
  explicit LabControlGrace(Nanoseconds grace) : grace_(grace) {}

  /// True once the lab control has been lost for the grace period without interruption.
  /// @param is_lost  its name was present, and is no longer
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

/// Whether the lab control, which alone can stop all cars, is lost; it may return.
///
/// Three signs: the name of ours (messages/node_names) is no longer present; or stop requests,
/// which only the lab control reads (wire contract, 4.2), have had readers and for kGap have none.
/// The latter also detects the lab's own control centre, whose participant has the name that all
/// the lab's programs have, but one that was killed only after the lease of the lab's participants,
/// some 20 s. The third sign is faster: a lab control that has answered requests does not answer
/// kMostUnanswered in a row, sent every kRequestInterval. It is noticed 2.25 to 3.25 s after the
/// death, if answers came at once. All times are wall time.
class LabControlWatch {
 public:
  static constexpr Nanoseconds kRequestInterval = kNanosecondsPerSecond;
  static constexpr int kMostUnanswered = 3;
  /// The last of these counts as unanswered after this time.
  static constexpr Nanoseconds kAnswerTime = 250 * kNanosecondsPerMillisecond;

  /// A reader that is recreated is no loss. (Network gaps shorter than the lease do not show here.)
  static constexpr Nanoseconds kGap = 500 * kNanosecondsPerMillisecond;

  enum class Change : std::uint8_t { kNone, kLost, kBack };

  /// True if a request is to be sent now; it then counts as unanswered until an answer comes.
  [[nodiscard]] bool request_is_due(Nanoseconds now) {
    if (now < next_request_) return false;
    next_request_ = now + kRequestInterval;
    ++unanswered_;
    return true;
  }
  /// An answer of the lab control, to any participant's request.
  void receive_answer() {
    has_answered_ = true;
    unanswered_ = 0;
  }
  /// When request_is_due or, for lack of answers, look changes. @pre request_is_due was called
  [[nodiscard]] Nanoseconds next_request() const {
    return has_answered_ && unanswered_ == kMostUnanswered && !lost_at_ ? answers_until()
                                                                        : next_request_;
  }

  /// @param is_name_lost          the name was present, and is no longer
  /// @param stop_request_readers  matched now
  /// @param now                   never goes back
  Change look(bool is_name_lost, std::size_t stop_request_readers, Nanoseconds now) {
    if (stop_request_readers > 0) {
      had_readers_ = true;
      without_readers_since_.reset();
    } else if (had_readers_ && !without_readers_since_) {
      without_readers_since_ = now;
    }
    const bool is_lost = is_name_lost ||
                         (without_readers_since_ && now >= *without_readers_since_ + kGap) ||
                         is_unanswered(now);
    if (is_lost == lost_at_.has_value()) return Change::kNone;
    lost_at_ = is_lost ? std::optional{now} : std::nullopt;
    return is_lost ? Change::kLost : Change::kBack;
  }

  [[nodiscard]] bool is_lost() const { return lost_at_.has_value(); }
  /// The grace period is over.
  [[nodiscard]] bool is_lost_for_good(Nanoseconds now) const {
    return lost_at_ && now > *lost_at_ + kControllerStays;
  }
  /// When look or is_lost_for_good changes without an event.
  [[nodiscard]] std::optional<Nanoseconds> wake_up() const {
    if (lost_at_) return *lost_at_ + kControllerStays + 1;
    if (without_readers_since_) return *without_readers_since_ + kGap;
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_unanswered(Nanoseconds now) const {
    return has_answered_ && (unanswered_ > kMostUnanswered ||
                             (unanswered_ == kMostUnanswered && now >= answers_until()));
  }
  [[nodiscard]] Nanoseconds answers_until() const {
    return next_request_ - kRequestInterval + kAnswerTime;
  }

  bool has_answered_{};
  int unanswered_{};
  Nanoseconds next_request_{};
  bool had_readers_{};
  std::optional<Nanoseconds> without_readers_since_;
  std::optional<Nanoseconds> lost_at_;
};

}  // namespace hlc::machine
