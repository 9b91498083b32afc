#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/middleware/middleware_messages.hpp"

namespace hlc {

/// Messages of one kind that a tick waits for. A peer that owes its message for longer than the
/// patience is silent: nobody waits for it until its next message, whatever that is. All times are
/// wall time.
class DueMessages {
 public:
  /// @param name    of a peer, for the log
  /// @param silent  peers that are not waited for before their first message
  DueMessages(std::string (*name)(std::uint8_t), Nanoseconds patience,
              std::set<std::uint8_t> silent = {});

  /// A message has come from the peer.
  void received(std::uint8_t peer) { silent_.erase(peer); }

  /// A new wait begins.
  void begin(Nanoseconds now) { deadline_ = now + patience_; }
  /// True once nobody is waited for any more. Who has fallen silent is logged.
  /// @param peers  that owe their message now
  [[nodiscard]] bool are_in(const std::vector<std::uint8_t>& peers, Nanoseconds now,
                            MiddlewareActions& actions);
  /// Peers that the last are_in waited for.
  [[nodiscard]] std::size_t awaited() const { return awaited_; }
  /// When are_in changes though nothing comes.
  [[nodiscard]] Nanoseconds deadline() const { return deadline_; }

 private:
  std::string (*name_)(std::uint8_t);
  Nanoseconds patience_;
  std::set<std::uint8_t> silent_;
  Nanoseconds deadline_{};
  std::size_t awaited_{};
};

}  // namespace hlc
