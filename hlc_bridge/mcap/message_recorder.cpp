#include "hlc_bridge/mcap/message_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hlc::mcap {
namespace {

/// More than a process publishes in kFlushInterval. Beyond it a message is dropped: the disk hangs.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

/// With the first free name.
GrowingFile new_file(const MessageRecorder::Options& options) {
  std::error_code ignored;  // then the file cannot be created either
  std::filesystem::create_directories(options.folder, ignored);
  for (int n = 1;; ++n) {
    const std::string name = n == 1 ? options.process : fmt::format("{}_{}", options.process, n);
    const std::filesystem::path file = options.folder / (name + ".mcap");
    try {
      return {file, GrowingFile::Opening::kNew, options.on_failure};
    } catch (const std::system_error& error) {
      if (error.code() == std::errc::file_exists) continue;
      throw std::invalid_argument(fmt::format("{}: {}, must be a file that can be created",
                                              file.string(), error.code().message()));
    }
  }
}

}  // namespace

MessageRecorder::MessageRecorder(Options options)
    : options_(std::move(options)), file_(new_file(options_)) {
  bytes_ = kMagic;
  append_header(bytes_);
  writer_ = std::thread([this] { write_until_closed(); });
}

MessageRecorder::~MessageRecorder() { close(); }

void MessageRecorder::record(const PublishedMessage& message) {
  const Nanoseconds wall = options_.wall_time();
  bool is_first{};  // of those that the writing thread will take: it wakes up for no other
  {
    const std::lock_guard lock{mutex_};
    if (is_closed_ || has_failed_) return;
    is_first = bytes_.empty();
    if (bytes_.size() > kMostBytes) {
      has_failed_ = true;
      return;
    }
    Topic& topic = topic_of(message);
    if (message.run) newest_ = std::max(newest_, *message.run);
    append_message(bytes_, {.channel = topic.channel,
                            .sequence = topic.count++,
                            .log_time = message.run.value_or(newest_),
                            .publish_time = wall,
                            .payload = message.cdr});
  }
  if (is_first) changed_.notify_one();
}

MessageRecorder::Topic& MessageRecorder::topic_of(const PublishedMessage& message) {
  const auto id = static_cast<std::uint16_t>(topics_.size() + 1);
  const auto [found, is_new] = topics_.try_emplace(message.topic, Topic{.channel = id});
  if (is_new) {
    append_schema(
        bytes_, id,
        {.name = message.type, .encoding = "omgidl", .text = options_.definition_of(message.type)});
    append_channel(bytes_, id,
                   {.schema = id,
                    .topic = message.topic,
                    .encoding = "cdr",
                    .metadata = {{"publisher", options_.process}}});
  }
  return found->second;
}

void MessageRecorder::write_until_closed() {
  std::unique_lock lock{mutex_};
  while (!is_closed_ || !bytes_.empty()) {
    changed_.wait(lock, [this] { return is_closed_ || !bytes_.empty(); });
    changed_.wait_for(lock, kFlushInterval, [this] { return is_closed_; });
    std::string bytes;
    bytes.swap(bytes_);
    bytes_.reserve(bytes.size());
    lock.unlock();
    file_.write(bytes);
    lock.lock();
    has_failed_ = has_failed_ || file_.has_failed();
    if (!has_failed_) continue;
    lock.unlock();
    file_.fail("the disk is too slow");  // the only other reason
    return;
  }
}

bool MessageRecorder::close() {
  {
    const std::lock_guard lock{mutex_};
    if (!is_closed_ && !has_failed_) append_end(bytes_);
    is_closed_ = true;
  }
  changed_.notify_one();
  if (writer_.joinable()) writer_.join();
  return !file_.close().has_value();
}

}  // namespace hlc::mcap
