#pragma once

#include <optional>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"

namespace hlc::high_level_controller {

/// Publishes commands and their copies for later (command.hpp): a command at once, its copy
/// according to HlcRules.
class CommandCopies {
 public:
  /// Between a command and its copy. Short: a controller that dies in between leaves a car that
  /// drops its plan after kCommandLifetime and brakes.
  static constexpr Nanoseconds kPause = 5 * kNanosecondsPerMillisecond;

  explicit CommandCopies(CommandCopy rule) : rule_(rule) {}

  /// A pending copy is published first. @param wall  now
  void publish(const AnswerToList& answer, Nanoseconds wall, HlcActions& actions) {
    publish_copy(actions);
    actions.add(answer.command);
    if (!answer.copy) return;
    if (rule_ == CommandCopy::kAtOnce) actions.add(*answer.copy);
    if (rule_ == CommandCopy::kAfterPause) {
      waiting_ = answer.copy;
      due_ = wall + kPause;
    }
  }

  void publish_when_due(Nanoseconds wall, HlcActions& actions) {
    if (wall >= due_) publish_copy(actions);
  }

  /// Wall time at which the pending copy is to be published; none: no copy is pending.
  [[nodiscard]] std::optional<Nanoseconds> due() const {
    return waiting_ ? std::optional{due_} : std::nullopt;
  }
  void drop() { waiting_.reset(); }

 private:
  void publish_copy(HlcActions& actions) {
    if (waiting_) actions.add(*std::exchange(waiting_, std::nullopt));
  }

  CommandCopy rule_;
  std::optional<TrajectoryCommand> waiting_;
  Nanoseconds due_{};
};

}  // namespace hlc::high_level_controller
