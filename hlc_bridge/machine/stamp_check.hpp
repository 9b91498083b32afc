#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/machine/log_line.hpp"
#include "hlc_bridge/messages/validate.hpp"

namespace hlc::machine {

/// A received message as StampCheck sees it.
struct StampedMessage {
  const char* kind{};                     ///< "command"; a literal
  std::string (*sender)(std::uint8_t){};  ///< name of the process that sends this kind
  std::uint8_t vehicle_id{};              ///< of the sender
  Nanoseconds stamp{};                    ///< the latest of the message
};

/// Keeps messages out whose stamp is not plausible (is_plausible_stamp). Where the largest stamp
/// counts, one of them would replace all later messages. Each is counted; the first one of each
/// kind and sender is logged.
class StampCheck {
 public:
  /// False: the message is to be dropped.
  /// @param period   ns, of the run; 0 if unknown
  /// @param actions  gets LogLine
  template <class Action>
  [[nodiscard]] bool accepts(const StampedMessage& message, const Instant& now, Nanoseconds period,
                             std::vector<Action>& actions) {
    if (is_plausible_stamp(message.stamp, now, period)) return true;
    ++dropped_;
    if (logged_.emplace(message.kind, message.vehicle_id).second) {
      actions.emplace_back(
          warning(std::string{message.kind} + " of " + message.sender(message.vehicle_id) +
                  " dropped: stamp must be <= " + std::to_string(now.run + kMostLead + period) +
                  " ns, got " + std::to_string(message.stamp) + " (logged once)"));
    }
    return false;
  }

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  std::set<std::pair<std::string, std::uint8_t>> logged_;  ///< kind, sender
  std::uint64_t dropped_{};
};

}  // namespace hlc::machine
