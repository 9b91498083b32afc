#pragma once

#include <deque>
#include <optional>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"

namespace hlc::high_level_controller {

/// Publishes commands and their copies for later (command.hpp): a command at once, its copies
/// according to HlcRules.
class CommandCopies {
 public:
  /// Between a command and its copy, and from copy to copy. Short: a controller that dies in
  /// between leaves a car that drops its plan after kCommandLifetime and brakes.
  static constexpr Nanoseconds kPause = 5 * kNanosecondsPerMillisecond;

  explicit CommandCopies(CommandCopy rule) : rule_(rule) {}

  /// Pending copies are published first. @param wall  now
  void publish(const AnswerToList& answer, Nanoseconds wall, HlcActions& actions) {
    while (!waiting_.empty()) publish_next(actions);
    actions.add(answer.command);
    if (rule_ == CommandCopy::kAtOnce) {
      for (const TrajectoryCommand& copy : answer.copies) actions.add(copy);
    }
    if (rule_ == CommandCopy::kAfterPause) {
      waiting_.assign(answer.copies.begin(), answer.copies.end());
      due_ = wall + kPause;
    }
  }

  void publish_when_due(Nanoseconds wall, HlcActions& actions) {
    if (waiting_.empty() || wall < due_) return;
    publish_next(actions);
    due_ = wall + kPause;
  }

  /// Wall time at which the next pending copy is to be published; none: no copy is pending.
  [[nodiscard]] std::optional<Nanoseconds> due() const {
    return waiting_.empty() ? std::nullopt : std::optional{due_};
  }
  void drop() { waiting_.clear(); }

 private:
  void publish_next(HlcActions& actions) {
    actions.add(std::move(waiting_.front()));
    waiting_.pop_front();
  }

  CommandCopy rule_;
  std::deque<TrajectoryCommand> waiting_;
  Nanoseconds due_{};
};

}  // namespace hlc::high_level_controller
