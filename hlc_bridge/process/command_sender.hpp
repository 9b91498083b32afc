#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// Sends the answers to state lists to the middleware, each command with its copy for later
/// (hlc/command.hpp): at once on loopback, on the lab's transport in real time after a pause,
/// since the reader of the lab's middleware keeps one sample. There not at all in logical time.
class CommandSender {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param on_matched_change  only notifies (Writer)
  CommandSender(Participant& local, bool logical_time, std::function<void()> on_matched_change);

  /// Readers of commands now.
  [[nodiscard]] std::size_t matched() const { return writer_.matched(); }

  /// A copy that still waits goes before it.
  void send(const AnswerToList& answer);

  /// When a copy waits: until then.
  [[nodiscard]] std::optional<Clock::time_point> copy_due() const;
  void send_copy_when_due();
  /// Waits until it is due, milliseconds.
  void send_copy_after_its_pause();
  void drop_copy() { waiting_copy_.reset(); }

 private:
  struct WaitingCopy {
    Clock::time_point due;
    TrajectoryCommand command;
  };

  Transport transport_;
  bool logical_time_;
  Writer<TrajectoryCommand> writer_;
  std::optional<WaitingCopy> waiting_copy_;
};

}  // namespace hlc
