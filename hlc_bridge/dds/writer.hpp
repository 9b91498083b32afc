#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/topics.hpp"

namespace hlc::dds {

class WriterEndpoint;  // Fast DDS lives behind this

/// Writes messages of one type on one topic.
///
/// A message written on a volatile topic before a reader has matched is lost for that reader: where
/// the first message must not be lost, wait for the match on the writer's side. Matches with the
/// own participant do not count.
template <class Message>
class Writer {
 public:
  /// `on_matched_change` is called on a DDS thread after a change of matched(), possibly before the
  /// constructor has returned, and never after the destructor. It must only notify. Throws
  /// std::invalid_argument if the topic does not belong on the participant's domain,
  /// std::runtime_error if the library refuses.
  Writer(Participant& participant, const Topic<Message>& topic,
         std::function<void()> on_matched_change = {});
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// False if the message was not accepted (the library's history is blocked, or the vehicle id of
  /// a keyed topic is out of range). Not to be called with a lock held that a callback takes. From
  /// any thread.
  bool write(const Message& message);

  /// Number of readers matched now.
  [[nodiscard]] std::size_t matched() const;
  /// Names of the readers' participants.
  [[nodiscard]] std::set<std::string> matched_names() const;
  /// Waits until at least `count` readers are matched; false if `deadline` passes first.
  [[nodiscard]] bool wait_for_matched(std::size_t count,
                                      std::chrono::steady_clock::time_point deadline) const;
  /// Waits until readers of all these participants are matched; false if `deadline` passes first.
  [[nodiscard]] bool wait_for_matched(const std::set<std::string>& names,
                                      std::chrono::steady_clock::time_point deadline) const;

 private:
  std::unique_ptr<WriterEndpoint> endpoint_;
};

}  // namespace hlc::dds
