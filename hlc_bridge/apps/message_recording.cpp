#include "hlc_bridge/apps/message_recording.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "hlc_bridge/dds/type_definition.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/time/real_time.hpp"

namespace hlc::apps {
namespace {

std::string domain_name(dds::DomainRole role) {
  if (role == dds::DomainRole::kLab) return "lab/";
  return role == dds::DomainRole::kLocal ? "local/" : "controllers/";
}

std::optional<Nanoseconds> time_of(const dds::MessageStamp& stamp, Nanoseconds period) {
  return stamp.step ? stamp.step->value * period : stamp.time;
}

}  // namespace

MessageRecording::OnPublished MessageRecording::open(const std::filesystem::path& folder,
                                                     bool simulated_time,
                                                     const std::string& process,
                                                     Nanoseconds period) {
  if (folder.empty()) return {};
  recorder_ = std::make_shared<mcap::MessageRecorder>(
      mcap::MessageRecorder::Options{.folder = folder,
                                     .process = process,
                                     .definition_of = dds::type_definition,
                                     .wall_time = time::real_time_now,
                                     .on_failure = [process](const std::string& line) {
                                       spdlog::warn(fmt::format("{}: {}", process, line));
                                     }});
  // In real time the clock's time is the run's.
  return [recorder = recorder_, period, simulated_time](const dds::PublishedMessage& message) {
    recorder->record(
        {.topic = domain_name(message.role) + message.topic,
         .type = message.type,
         .cdr = message.cdr,
         .run = simulated_time ? time_of(message.stamp, period) : time::real_time_now()});
  };
}

int MessageRecording::close(int exit_code) const {
  const bool is_complete = !recorder_ || recorder_->close();
  if (!is_complete) spdlog::warn(fmt::format("{}: incomplete", recorder_->file().string()));
  return exit_code_with_outputs(exit_code, is_complete);
}

}  // namespace hlc::apps
