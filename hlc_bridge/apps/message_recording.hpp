#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/mcap/message_recorder.hpp"

namespace hlc::apps {

/// The recorder of a process of a run, if its flags ask for one (--messages_folder).
class MessageRecording {
 public:
  using OnPublished = std::function<void(const dds::PublishedMessage&)>;

  /// For ParticipantOptions::on_published; empty if there is no folder.
  /// @param folder, simulated_time  of the flags
  /// @param period  of the run's steps
  /// @throws std::invalid_argument if the file cannot be created
  [[nodiscard]] OnPublished open(const std::filesystem::path& folder, bool simulated_time,
                                 const std::string& process, Nanoseconds period = kLabPeriod);

  /// The process's exit code once its messages are written: kExitNotWritten instead of success if
  /// one could not be.
  [[nodiscard]] int close(int exit_code) const;

 private:
  /// No other is driven by processes.
  static constexpr Nanoseconds kLabPeriod = 200'000'000;

  std::shared_ptr<mcap::MessageRecorder> recorder_;
};

}  // namespace hlc::apps
