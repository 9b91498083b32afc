#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hlc_bridge/render/child_process.hpp"

namespace hlc::render {

/// Pictures that follow each other at equal times, as a video that ffmpeg writes.
class Video {
 public:
  /// @param file    to be written; its name ends in .mp4 (H.264) or .gif
  /// @param log     file for what ffmpeg reports
  /// @throws Fault if there is no ffmpeg
  Video(const std::filesystem::path& file, int frames_per_s, std::filesystem::path log);

  /// @param png  of the same size as the others; even numbers of px
  /// @throws Fault with the last line of the log
  void add(std::string_view png);
  /// Returns when the file is written. @throws Fault with the last line of the log
  void finish();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path log_;
  Pipe frames_{make_pipe()};
  ChildProcess process_;
};

}  // namespace hlc::render
