#include "hlc_bridge/process/progress_line.hpp"

namespace hlc::process {

void ProgressLine::show(const std::string& text) {
  if (is_terminal_) {
    const std::string line =
        text.size() <= kTerminalColumns ? text : text.substr(0, kTerminalColumns - 3) + "...";
    std::fprintf(stream_, "\r\x1b[K%s", line.c_str());  // to the line's begin, clear it
  } else {
    std::fprintf(stream_, "%s\n", text.c_str());
  }
  std::fflush(stream_);
  is_open_ = is_terminal_;
}

void ProgressLine::end_line() {
  if (is_open_) {
    std::fprintf(stream_, "\n");
    std::fflush(stream_);
    is_open_ = false;
  }
}

}  // namespace hlc::process
