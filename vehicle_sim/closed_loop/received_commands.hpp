#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::closed_loop {

/// What a vehicle has received, and which of it counts by its rule (CommandBuffer): of the commands
/// that are valid the one created last, of equal ones the last arrival. So a copy that has
/// overtaken its command does not count.
class ReceivedCommands {
 public:
  void add(const TrajectoryCommand& command) {
    waiting_.push_back({.create = command.create_stamp,
                        .number = ++num_received_,
                        .valid_after = command.valid_after_stamp});
  }
  void take_valid(Nanoseconds tick) {
    std::erase_if(waiting_, [&](const Received& one) {
      if (one.valid_after > tick) return false;
      if (std::tie(one.create, one.number) > std::tie(newest_.create, newest_.number))
        newest_ = one;
      return true;
    });
  }
  /// What is not valid yet.
  void drop_waiting() { waiting_.clear(); }

  /// create_stamp of the command that counts; 0: none.
  [[nodiscard]] Nanoseconds newest() const { return newest_.create; }
  [[nodiscard]] Nanoseconds usable_until() const { return newest_.valid_after + kCommandLifetime; }

 private:
  struct Received {
    Nanoseconds create{};
    std::uint64_t number{};
    Nanoseconds valid_after{};
  };
  std::vector<Received> waiting_;  ///< in the order of arrival
  Received newest_;
  std::uint64_t num_received_{};
};

}  // namespace hlc::closed_loop
