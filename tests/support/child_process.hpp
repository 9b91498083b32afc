#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hlc::test {

/// A program started by a test, in a process group of its own. Whatever is left of it ends with
/// this object.
class ChildProcess {
 public:
  /// @param arguments  program and flags; the program as a path
  /// @param output     file for standard output and standard error
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& output);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Exit code (128 + signal if a signal ended it), or nothing if it still runs at the deadline.
  [[nodiscard]] std::optional<int> wait_for(std::chrono::milliseconds time);
  /// To the program alone.
  void send(int signal) const;

 private:
  pid_t pid_{-1};
  std::optional<int> exit_code_;
};

/// Waits for all of them. Names of those that still run at the deadline.
[[nodiscard]] std::vector<std::string> still_running(std::map<std::string, ChildProcess>& processes,
                                                     std::chrono::seconds time);

/// The whole file; empty if there is none.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// True as soon as `condition` holds; asked again and again until the deadline, but seldom enough
/// for a condition that reads whole files to leave the processor to the awaited processes.
template <class Condition>
[[nodiscard]] bool eventually(std::chrono::milliseconds time, Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + time;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    ::usleep(20'000);
  }
  return true;
}

}  // namespace hlc::test
