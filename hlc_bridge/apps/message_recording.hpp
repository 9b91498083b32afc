#pragma once

#include <spdlog/spdlog.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/type_definition.hpp"
#include "hlc_bridge/mcap/message_recorder.hpp"
#include "hlc_bridge/time/real_time.hpp"

namespace hlc::apps {

/// The recorder of a process of a run, if its flags ask for one (--messages).
class MessageRecording {
 public:
  using OnPublished = std::function<void(const dds::PublishedMessage&)>;

  /// For ParticipantOptions::on_published; empty without the flag.
  /// @param period  of the run's steps
  /// @throws std::invalid_argument if the file cannot be created
  OnPublished open(const NetworkFlags& flags, const std::string& process,
                   Nanoseconds period = kLabPeriod) {
    if (flags.messages.empty()) return {};
    recorder_ = std::make_shared<mcap::MessageRecorder>(
        mcap::MessageRecorder::Options{.folder = flags.messages,
                                       .process = process,
                                       .definition_of = dds::type_definition,
                                       .wall_time = time::real_time_now,
                                       .is_logical = flags.simulated_time,
                                       .on_failure = [process](const std::string& line) {
                                         spdlog::warn("{}: {}", process, line);
                                       }});
    return [recorder = recorder_, period](const dds::PublishedMessage& message) {
      recorder->record({.topic = domain_name(message.role) + message.topic,
                        .type = message.type,
                        .cdr = message.cdr,
                        .run = message.step ? message.step->value * period : message.time});
    };
  }

  /// The process's exit code once its messages are written: kExitNotWritten instead of success if
  /// one could not be.
  [[nodiscard]] int close(int exit_code) const {
    const bool is_complete = !recorder_ || recorder_->close();
    return exit_code == kExitGood && !is_complete ? kExitNotWritten : exit_code;
  }

 private:
  static std::string domain_name(dds::DomainRole role) {
    if (role == dds::DomainRole::kLab) return "lab/";
    return role == dds::DomainRole::kLocal ? "local/" : "controllers/";
  }

  /// No other is driven by processes.
  static constexpr Nanoseconds kLabPeriod = 200'000'000;

  std::shared_ptr<mcap::MessageRecorder> recorder_;
};

}  // namespace hlc::apps
