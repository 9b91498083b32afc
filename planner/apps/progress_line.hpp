#pragma once

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "planner/apps/terminal.hpp"

namespace hlc::apps {

/// "what 13 of 64, 00:02:10 left" on stderr, updated in place, cut off at the terminal's width and
/// erased at the end; nothing if stderr is no terminal.
class ProgressLine {
 public:
  ProgressLine(std::string what, std::size_t total)
      : what_(std::move(what)), total_(total), is_shown_(isatty(STDERR_FILENO) == 1) {}
  ~ProgressLine() {
    if (is_shown_) std::fprintf(stderr, "\r\033[K");
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @pre done >= 1
  /// @param more  behind the remaining time
  void show(std::size_t done, const std::string& more = "") const {
    if (!is_shown_) return;
    const auto passed = std::chrono::steady_clock::now() - begin_;
    const auto left = std::chrono::duration_cast<std::chrono::seconds>(
        passed / static_cast<double>(done) * static_cast<double>(total_ - done));
    std::string text = fmt::format("{} {} of {}, {:%T} left{}", what_, done, total_, left, more);
    text.resize(std::min(text.size(), columns_of(STDERR_FILENO) - 1));
    fmt::print(stderr, "\r\033[K{}", text);
  }

 private:
  std::string what_;
  std::size_t total_;
  bool is_shown_;
  std::chrono::steady_clock::time_point begin_{std::chrono::steady_clock::now()};
};

}  // namespace hlc::apps
