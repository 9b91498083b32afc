#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc::dds {

/// Long enough for a busy machine with sanitizers; only a failing test waits for it.
inline std::chrono::steady_clock::time_point soon() {
  return std::chrono::steady_clock::now() + std::chrono::seconds{60};
}

inline ParticipantOptions on_loopback(std::string name, int domain, DomainRole role) {
  ParticipantOptions options;
  options.name = std::move(name);
  options.domain_id = domain;
  options.role = role;
  options.transport = Transport::kLoopback;
  return options;
}

/// A reader with an inbox, as processes have it.
template <class Message>
class Mailbox {
 public:
  Mailbox(Participant& participant, const Topic<Message>& topic)
      : reader_{
            participant, topic,
            [this](const Message& message) { signal_.post([&] { messages_.push_back(message); }); },
            [this] { signal_.notify(); }} {}

  /// What has come as soon as there are `count` messages; what there is if they do not come.
  [[nodiscard]] std::vector<Message> wait_for(std::size_t count) const {
    static_cast<void>(signal_.wait_until(soon(), [&] { return messages_.size() >= count; }));
    return signal_.locked([&] { return messages_; });
  }

  [[nodiscard]] std::vector<Message> now() const {
    return signal_.locked([&] { return messages_; });
  }

  /// For conditions on the reader's matches.
  template <class Condition>
  [[nodiscard]] bool wait_until(Condition condition) const {
    return signal_.wait_until(soon(), condition);
  }

  [[nodiscard]] Reader<Message>& reader() { return reader_; }

 private:
  time::Signal signal_;
  std::vector<Message> messages_;
  Reader<Message> reader_;  // last: its callbacks use the others
};

}  // namespace hlc::dds
