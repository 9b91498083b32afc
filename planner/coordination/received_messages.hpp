#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "planner/coordination/messages.hpp"

namespace hlc::coordination {

/// Messages of one kind that a vehicle has received, sorted by sender. They are shared: within one
/// process all receivers read the same copy.
template <class Message>
class ReceivedMessages {
 public:
  using Pointer = std::shared_ptr<const Message>;

  ReceivedMessages() = default;
  /// Copies of messages, several of a sender if they are of different steps.
  ReceivedMessages(const std::vector<Message>& messages) {  // NOLINT(google-explicit-constructor)
    for (const Message& one : messages) messages_.push_back(std::make_shared<const Message>(one));
    std::ranges::stable_sort(messages_, {}, &sender);
  }

  [[nodiscard]] const std::vector<Pointer>& all() const { return messages_; }

  /// Takes the message, in place of a former one of its sender.
  void put(Pointer message) {
    const auto at = std::ranges::lower_bound(messages_, message->vehicle, {}, &sender);
    if (at != messages_.end() && (*at)->vehicle == message->vehicle) {
      *at = std::move(message);
    } else {
      messages_.insert(at, std::move(message));
    }
  }

  [[nodiscard]] bool contains(VehicleId from) const {
    return std::ranges::binary_search(messages_, from, {}, &sender);
  }

  /// The message of one vehicle in one step, if it has been received and is well-formed; otherwise
  /// nullptr.
  [[nodiscard]] Pointer find(VehicleId from, StepIndex step) const {
    for (const Pointer& one : std::ranges::equal_range(messages_, from, {}, &sender)) {
      if (one->step == step) return is_well_formed(*one) ? one : nullptr;
    }
    return nullptr;
  }

 private:
  [[nodiscard]] static VehicleId sender(const Pointer& message) { return message->vehicle; }

  std::vector<Pointer> messages_;
};

}  // namespace hlc::coordination
