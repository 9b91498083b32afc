#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/sender.hpp"
#include "hlc_bridge/dds/topics.hpp"

namespace hlc::dds {

class ReaderEndpoint;  // Fast DDS lives behind this

/// Passes on every valid message of one topic, in the order of arrival (per writer: of writing).
///
/// A message is valid if its enumerations are in range, all numbers are finite and sizes are
/// plausible (convert_lab.hpp, convert_hlc.hpp). Others are dropped and counted.
template <class Message>
class Reader {
 public:
  /// `on_message` is called on a DDS thread, one call at a time, possibly before the constructor
  /// has returned, and never after the destructor. It must only queue and notify (Signal::post): no
  /// write, no wait, no creation or destruction of an endpoint. The same holds for
  /// `on_matched_change`, called after a change of matched(). `sender`: who alone may publish the
  /// messages. Throws std::invalid_argument if the
  /// topic does not belong on the participant's domain, std::runtime_error if the library refuses.
  Reader(Participant& participant, const Topic<Message>& topic,
         std::function<void(const Message&)> on_message,
         std::function<void()> on_matched_change = {}, SenderOf<Message> sender = {});
  /// Waits for a running callback: not to be called with a lock held that a callback takes.
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Number of writers matched now (those of the own participant do not count).
  [[nodiscard]] std::size_t matched() const;
  /// Names of the writers' participants.
  [[nodiscard]] std::set<std::string> matched_names() const;
  /// Waits until at least `count` writers are matched; false if `deadline` passes first.
  [[nodiscard]] bool wait_for_matched(std::size_t count,
                                      std::chrono::steady_clock::time_point deadline) const;
  /// Waits until writers of all these participants are matched; false if `deadline` passes first.
  [[nodiscard]] bool wait_for_matched(const std::set<std::string>& names,
                                      std::chrono::steady_clock::time_point deadline) const;

  /// Invalid messages dropped so far.
  [[nodiscard]] std::uint64_t dropped() const;
  /// Messages dropped so far since they were not published by their sender.
  [[nodiscard]] std::uint64_t of_others() const;
  /// Messages that the history could not hold, the transport lost, or the process did not admit
  /// (reliable topics: should stay 0).
  [[nodiscard]] std::uint64_t lost() const;

 private:
  std::unique_ptr<ReaderEndpoint> endpoint_;
};

}  // namespace hlc::dds
