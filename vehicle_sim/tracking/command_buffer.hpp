#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <tuple>
#include <utility>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::tracking {

/// The received commands of one kind, and the choice of the one to follow.
///
/// The lab's rule: of the commands with valid_after <= t_now the one with the largest create_stamp
/// is active, of equal ones the later arrival. It is usable while t_now - valid_after <
/// kCommandLifetime. If it is not, none is, even if an older command is valid for longer: a newer
/// command replaces an older one for good.
///
/// At most `kCapacity` commands wait for their time; beyond that the earliest arrival is dropped,
/// never the active one.
template <class Command>
class CommandBuffer {
 public:
  static constexpr std::size_t kCapacity = 100;

  /// Calls must follow the order of arrival.
  void add(Command command) {
    if (waiting_.size() == kCapacity) {
      waiting_.pop_front();
    }
    waiting_.push_back({.command = std::move(command), .number = arrivals_++});
  }

  /// The command to follow at `t_now`, or nullptr. Valid until the next call. `t_now` must not
  /// decrease.
  [[nodiscard]] const Command* usable_at(Nanoseconds t_now) {
    for (Arrival& arrival : waiting_) {
      const bool is_valid = arrival.command.valid_after_stamp <= t_now;
      if (is_valid && (!active_ || arrival.replaces(*active_))) {
        active_ = std::move(arrival);
      }
    }
    // Commands valid by now have either been activated or are older than the active one.
    std::erase_if(waiting_, [&](const Arrival& arrival) {
      return arrival.command.valid_after_stamp <= t_now;
    });
    const bool is_usable = active_ && t_now - active_->command.valid_after_stamp < kCommandLifetime;
    return is_usable ? &active_->command : nullptr;
  }

  /// Drops all commands, as after a stop.
  void clear() {
    active_.reset();
    waiting_.clear();
  }

 private:
  struct Arrival {
    Command command;
    std::uint64_t number{};  ///< counts arrivals

    [[nodiscard]] bool replaces(const Arrival& other) const {
      return std::tie(command.create_stamp, number) >
             std::tie(other.command.create_stamp, other.number);
    }
  };

  std::uint64_t arrivals_{};
  std::optional<Arrival> active_;
  std::deque<Arrival> waiting_;  ///< in order of arrival, not yet valid when last asked
};

}  // namespace hlc::tracking
