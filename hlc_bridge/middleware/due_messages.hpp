#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/middleware/middleware_messages.hpp"

namespace hlc::middleware {

/// Messages of one kind that a tick waits for. A peer whose message is overdue for longer than the
/// patience is silent: it is not awaited until its next message of any kind. All times are wall
/// time.
class DueMessages {
 public:
  /// @param name    of a peer, for the log
  /// @param silent  peers that are not awaited before their first message
  DueMessages(std::string (*name)(std::uint8_t), Nanoseconds patience,
              std::set<std::uint8_t> silent = {});

  /// A message of the peer was received.
  void received(std::uint8_t peer) { silent_.erase(peer); }

  /// A new wait begins.
  void begin(Nanoseconds now) { deadline_ = now + patience_; }
  /// True once no peer is awaited. Peers that have fallen silent are logged.
  /// @param peers  whose message is pending
  [[nodiscard]] bool are_in(const std::vector<std::uint8_t>& peers, Nanoseconds now,
                            MiddlewareActions& actions);
  /// Number of peers that the last are_in waited for.
  [[nodiscard]] std::size_t awaited() const { return awaited_; }
  /// When are_in changes without an event.
  [[nodiscard]] Nanoseconds deadline() const { return deadline_; }

 private:
  std::string (*name_)(std::uint8_t);
  Nanoseconds patience_;
  std::set<std::uint8_t> silent_;
  Nanoseconds deadline_{};
  std::size_t awaited_{};
};

}  // namespace hlc::middleware
