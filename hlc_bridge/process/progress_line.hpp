#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::process {

/// Shows the operator the progress of the run: on a terminal one line that is rewritten, otherwise
/// (log files) a line each time.
class ProgressLine {
 public:
  static constexpr std::size_t kTerminalColumns = 79;
  static constexpr Nanoseconds kTerminalInterval = 100'000'000;
  static constexpr Nanoseconds kLogInterval = 5'000'000'000;

  /// From one line to the next (ProgressTimes).
  [[nodiscard]] static constexpr Nanoseconds interval(bool is_terminal) {
    return is_terminal ? kTerminalInterval : kLogInterval;
  }

  ProgressLine(std::FILE* stream, bool is_terminal) : stream_{stream}, is_terminal_{is_terminal} {}

  /// On a terminal cut to one line.
  void show(const std::string& text);
  /// Ends a rewritten line, so that further output starts on the next line.
  void end_line();

 private:
  std::FILE* stream_;
  bool is_terminal_;
  bool is_open_{};  ///< the terminal's line has no line break yet
};

}  // namespace hlc::process
