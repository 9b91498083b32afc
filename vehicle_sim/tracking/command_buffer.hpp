#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "hlc_bridge/core/messages.hpp"

namespace hlc {

/// The trajectory commands that a vehicle has received, and which of them it follows.
///
/// The lab's rule: of the commands with valid_after <= t_now the one with the largest create_stamp
/// is active, of equal ones the later arrival. It is usable while t_now - valid_after <
/// kCommandLifetime. If it is not, none is, even if an older command is valid for longer: a newer
/// word replaces an older one for good.
///
/// At most `kCapacity` commands wait for their time; beyond that the earliest arrival makes room.
/// The active one never has to.
class CommandBuffer {
 public:
  static constexpr std::size_t kCapacity = 100;

  /// Calls must follow the order of arrival.
  void add(TrajectoryCommand command);

  /// The command to follow at `t_now`, or nullptr. Valid until the next call. `t_now` must not
  /// decrease.
  [[nodiscard]] const TrajectoryCommand* usable_at(Nanoseconds t_now);

  /// Forgets everything, as after a stop.
  void clear();

 private:
  struct Arrival {
    TrajectoryCommand command;
    std::uint64_t number{};  ///< counts arrivals

    [[nodiscard]] bool replaces(const Arrival& other) const;
  };

  std::uint64_t arrivals_{};
  std::optional<Arrival> active_;
  std::deque<Arrival> waiting_;  ///< in order of arrival, not yet valid when last asked
};

}  // namespace hlc
