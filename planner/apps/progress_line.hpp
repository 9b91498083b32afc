#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

namespace hlc::apps {

/// "what 13 of 64" on stderr, updated in place and erased at the end; nothing if stderr is no
/// terminal.
class ProgressLine {
 public:
  ProgressLine(std::string what, std::size_t total)
      : what_(std::move(what)), total_(total), is_shown_(isatty(STDERR_FILENO) == 1) {}
  ~ProgressLine() {
    if (is_shown_) std::fprintf(stderr, "\r\033[K");
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::size_t done) const {
    if (is_shown_) std::fprintf(stderr, "\r%s %zu of %zu", what_.c_str(), done, total_);
  }

 private:
  std::string what_;
  std::size_t total_;
  bool is_shown_;
};

}  // namespace hlc::apps
