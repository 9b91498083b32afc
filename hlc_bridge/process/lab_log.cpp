#include "hlc_bridge/process/lab_log.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <mutex>
#include <utility>

#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/time/real_time.hpp"

namespace hlc::process {
namespace {

std::uint16_t lab_level(spdlog::level::level_enum level) {
  if (level >= spdlog::level::err) return 1;
  return level == spdlog::level::warn ? 2 : 3;
}

}  // namespace

class LabLog::Sink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  Sink(dds::Participant& lab, std::string node_id)
      : node_id_(std::move(node_id)),
        writer_(lab, dds::topics::log()),
        level_reader_(lab, dds::topics::log_level(),
                      [this](const LogLevel& level) { highest_ = level.level; }) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::uint16_t level = lab_level(message.level);
    if (level > highest_) return;
    writer_.write({.id = node_id_,
                   .content = std::string(message.payload.begin(), message.payload.end()),
                   .stamp = time::real_time_now(),
                   .level = level});
  }
  void flush_() override {}

 private:
  std::string node_id_;
  std::atomic<std::uint16_t> highest_{1};
  dds::Writer<Log> writer_;
  dds::Reader<LogLevel> level_reader_;
};

LabLog::LabLog(dds::Participant& lab, std::string node_id)
    : sink_(std::make_shared<Sink>(lab, std::move(node_id))) {
  // A logger's sinks must not change while another thread logs: the former logger is replaced.
  const auto former = spdlog::default_logger();
  const auto logger = std::make_shared<spdlog::logger>(former->name(), former->sinks().begin(),
                                                       former->sinks().end());
  logger->set_level(former->level());
  logger->flush_on(former->flush_level());
  logger->sinks().push_back(sink_);
  spdlog::set_default_logger(logger);
}

LabLog::~LabLog() {
  const auto former = spdlog::default_logger();
  const auto logger = std::make_shared<spdlog::logger>(former->name());
  logger->set_level(former->level());
  logger->flush_on(former->flush_level());
  for (const auto& sink : former->sinks()) {
    if (sink != sink_) logger->sinks().push_back(sink);
  }
  spdlog::set_default_logger(logger);
}

}  // namespace hlc::process
