#pragma once

#include <optional>
#include <string>
#include <utility>

#include "hlc_bridge/hlc/hlc_events.hpp"

namespace hlc::high_level_controller {

/// Whether the own middleware is lost; it may be restarted. Without it nothing reaches the vehicle,
/// which drives its last command to the end.
///
/// Evidence: our middleware's name is lost, or no reader of commands is matched. (Others on the
/// local domain may come and go: in the lab it holds all controllers of a computer.)
class MiddlewareWatch {
 public:
  /// @param name      of our middleware
  /// @param patience  see HlcRules::middleware_patience
  MiddlewareWatch(std::string name, Nanoseconds patience)
      : name_(std::move(name)), patience_(patience) {}

  void receive(const HlcPeers& peers) {
    had_readers_ = had_readers_ || peers.command_readers > 0;
    is_absent_ = peers.local.lost.contains(name_) || (had_readers_ && peers.command_readers == 0);
  }

  /// @param wall  now
  void look(Nanoseconds wall, HlcActions& actions) {
    if (is_absent_ == lost_at_.has_value()) return;
    if (is_absent_) {
      actions.error(name_ + " lost; no commands reach the vehicle");
      lost_at_ = wall;
    } else {
      actions.info(name_ + " is back");
      lost_at_.reset();
    }
  }

  /// The grace period is over.
  [[nodiscard]] bool is_lost_for_good(Nanoseconds wall) const {
    return lost_at_ && (patience_ == 0 || wall > *lost_at_ + patience_);
  }
  [[nodiscard]] bool is_lost() const { return lost_at_.has_value(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Wall time at which the middleware is lost for good unless it returns.
  [[nodiscard]] std::optional<Nanoseconds> wake_up() const {
    return lost_at_ ? std::optional{*lost_at_ + patience_ + 1} : std::nullopt;
  }

 private:
  std::string name_;
  Nanoseconds patience_;
  bool had_readers_{};
  bool is_absent_{};
  std::optional<Nanoseconds> lost_at_;
};

}  // namespace hlc::high_level_controller
