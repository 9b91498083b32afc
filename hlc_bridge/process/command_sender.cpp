#include "hlc_bridge/process/command_sender.hpp"

#include <thread>

#include <utility>

#include "hlc_bridge/dds/topics.hpp"

namespace hlc {
namespace {

/// Short: who dies in it leaves a car that drops its plan after kCommandLifetime and brakes.
constexpr std::chrono::milliseconds kCopyPause{5};

}  // namespace

CommandSender::CommandSender(Participant& local, bool logical_time,
                             std::function<void()> on_matched_change)
    : transport_(local.options().transport),
      logical_time_(logical_time),
      writer_(local, topics::command(), std::move(on_matched_change)) {}

void CommandSender::send(const AnswerToList& answer) {
  if (waiting_copy_) writer_.write(waiting_copy_->command);
  waiting_copy_.reset();
  writer_.write(answer.command);
  if (!answer.copy) return;
  if (transport_ == Transport::kLoopback) {
    writer_.write(*answer.copy);
  } else if (!logical_time_) {
    waiting_copy_ = {.due = Clock::now() + kCopyPause, .command = *answer.copy};
  }
}

std::optional<CommandSender::Clock::time_point> CommandSender::copy_due() const {
  if (!waiting_copy_) return std::nullopt;
  return waiting_copy_->due;
}

void CommandSender::send_copy_after_its_pause() {
  if (!waiting_copy_) return;
  std::this_thread::sleep_until(waiting_copy_->due);
  send_copy_when_due();
}

void CommandSender::send_copy_when_due() {
  if (!waiting_copy_ || Clock::now() < waiting_copy_->due) return;
  writer_.write(waiting_copy_->command);
  waiting_copy_.reset();
}

}  // namespace hlc
