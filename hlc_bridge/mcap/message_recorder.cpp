#include "hlc_bridge/mcap/message_recorder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace hlc::mcap {
namespace {

/// More than a process publishes in kFlushInterval. Beyond it a message is dropped: the disk hangs.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

/// The first free name, and its descriptor.
std::pair<std::filesystem::path, int> new_file(const std::filesystem::path& folder,
                                               const std::string& process) {
  std::error_code ignored;  // then the file cannot be created either
  std::filesystem::create_directories(folder, ignored);
  for (int n = 1;; ++n) {
    std::filesystem::path file =
        folder / (n == 1 ? process + ".mcap" : fmt::format("{}_{}.mcap", process, n));
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {std::move(file), descriptor};
    if (errno != EEXIST) {
      throw std::invalid_argument(fmt::format("{}: {}, must be a file that can be created",
                                              file.string(), std::strerror(errno)));
    }
  }
}

}  // namespace

MessageRecorder::MessageRecorder(Options options) : options_(std::move(options)) {
  std::tie(file_, descriptor_) = new_file(options_.folder, options_.process);
  bytes_ = kMagic;
  append_header(bytes_);
  writer_ = std::thread([this] { write_until_closed(); });
}

MessageRecorder::~MessageRecorder() {
  close();
  ::close(descriptor_);
}

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
    const int error = write(bytes);
    lock.lock();
    has_failed_ = has_failed_ || error != 0;
    if (!has_failed_) continue;
    lock.unlock();
    options_.on_failure(fmt::format("{}: messages are no longer recorded: {}", file_.string(),
                                    error == 0 ? "the disk is too slow" : std::strerror(error)));
    return;
  }
}

int MessageRecorder::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

bool MessageRecorder::close() {
  {
    const std::lock_guard lock{mutex_};
    if (!is_closed_ && !has_failed_) append_end(bytes_);
    is_closed_ = true;
  }
  changed_.notify_one();
  if (writer_.joinable()) writer_.join();
  return !has_failed_;
}

}  // namespace hlc::mcap
