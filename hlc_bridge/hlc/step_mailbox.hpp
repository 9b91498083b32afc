#pragma once

#include <map>
#include <set>
#include <vector>

#include "planner/coordination/messages.hpp"

namespace hlc {

/// Messages of one kind by step and sender; older steps are dropped when a step begins. Plain data:
/// the owner holds the lock.
template <class Message>
class StepMailbox {
 public:
  /// The last message of a sender in a step counts. Steps before the current one are ignored, and
  /// so are those too far ahead to come from a sane sender.
  void put(const Message& message) {
    if (message.step < current_ || message.step.value > current_.value + kMaxStepsAhead) return;
    messages_[message.step][message.vehicle] = message;
  }

  /// Step `step` begins: what came for it is kept, what came before is dropped.
  void begin(StepIndex step) {
    current_ = step;
    messages_.erase(messages_.begin(), messages_.lower_bound(step));
  }

  [[nodiscard]] bool holds(VehicleId vehicle) const {
    const auto of_step = messages_.find(current_);
    return of_step != messages_.end() && of_step->second.contains(vehicle);
  }

  /// What has come for the current step, sorted by sender.
  [[nodiscard]] std::vector<Message> all() const {
    std::vector<Message> result;
    if (const auto of_step = messages_.find(current_); of_step != messages_.end()) {
      for (const auto& [vehicle, message] : of_step->second) result.push_back(message);
    }
    return result;
  }

 private:
  static constexpr std::uint64_t kMaxStepsAhead = 10;

  StepIndex current_{};
  std::map<StepIndex, std::map<VehicleId, Message>> messages_;
};

}  // namespace hlc
