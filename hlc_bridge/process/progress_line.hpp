#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc {

/// Tells the operator how far a run is: on a terminal one line that is rewritten, else (log files)
/// a line every five seconds.
class ProgressLine {
 public:
  /// Nothing is shown before: most starts and short runs are over by then.
  static constexpr Nanoseconds kQuietTime = 1'000'000'000;
  static constexpr std::size_t kTerminalColumns = 79;
  static constexpr Nanoseconds kTerminalInterval = 100'000'000;
  static constexpr Nanoseconds kLogInterval = 5'000'000'000;

  ProgressLine(std::FILE* stream, bool is_terminal) : stream_{stream}, is_terminal_{is_terminal} {}

  /// Shows `text` if the interval has passed since it did so last, and kQuietTime since the first
  /// call; `now` in wall time. On a terminal cut to one line.
  void update(Nanoseconds now, const std::string& text);
  /// When the next update would be shown.
  [[nodiscard]] Nanoseconds next() const { return next_.value_or(0); }
  /// Ends a rewritten line, so that other output stands below it.
  void end_line();

 private:
  std::FILE* stream_;
  bool is_terminal_;
  bool is_open_{};  ///< the terminal's line has no line break yet
  std::optional<Nanoseconds> next_;
};

}  // namespace hlc
