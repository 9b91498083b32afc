#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "hlc_bridge/mcap/records.hpp"
#include "planner/common/growing_file.hpp"

namespace hlc::mcap {

/// A message as it was published.
struct PublishedMessage {
  std::string topic;               ///< with the domain's name: lab/vehicle/3/vehicleState
  std::string type;                ///< in IDL: VehicleState, hlc::TrafficMessage
  std::string_view cdr;            ///< with its encapsulation header
  std::optional<Nanoseconds> run;  ///< time of the run; none: the newest of its process's messages
};

/// Records what one process publishes, while it publishes it: an MCAP file without an index. After
/// the process was killed it lacks at most what was published in the last kFlushInterval.
///
/// A process never waits for the disk: a thread of its own writes. What cannot be written is
/// dropped, and so is all that follows: the process goes on.
class MessageRecorder {
 public:
  static constexpr std::chrono::milliseconds kFlushInterval{500};

  struct Options {
    std::filesystem::path folder;  ///< created if it is missing
    std::string process;           ///< its name
    /// IDL of a type and of all that it uses.
    std::function<std::string(const std::string& type)> definition_of;
    std::function<Nanoseconds()> wall_time;
    /// On the writing thread.
    GrowingFile::OnFailure on_failure = [](const std::string&) {};
  };

  /// Makes a file of its own: <process>.mcap, or <process>_2.mcap for a process started again, ...
  /// @throws std::invalid_argument naming the file if it cannot be created
  explicit MessageRecorder(Options options);
  ~MessageRecorder();
  MessageRecorder(const MessageRecorder&) = delete;
  MessageRecorder& operator=(const MessageRecorder&) = delete;

  /// From any thread; waits for no disk.
  void record(const PublishedMessage& message);

  /// Writes what is left, and the file's end; nothing is recorded afterwards. False if something
  /// could not be written.
  bool close();

  [[nodiscard]] const std::filesystem::path& file() const { return file_.path(); }

 private:
  struct Topic {
    std::uint16_t channel{};  ///< id
    std::uint32_t count{};    ///< of messages
  };

  [[nodiscard]] Topic& topic_of(const PublishedMessage& message);
  void write_until_closed();

  Options options_;
  GrowingFile file_;  ///< of the writing thread

  std::mutex mutex_;  ///< guards the following ones
  std::condition_variable changed_;
  std::string bytes_;  ///< not yet written
  std::map<std::string, Topic> topics_;
  Nanoseconds newest_{};
  bool is_closed_{};
  bool has_failed_{};

  std::thread writer_;
};

}  // namespace hlc::mcap
