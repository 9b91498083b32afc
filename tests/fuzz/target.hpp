#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hlc::fuzz {

/// A reader of bytes that others wrote.
struct Target {
  std::string name;
  /// Reads the bytes. Throws only what it should: std::invalid_argument or std::runtime_error, not
  /// of a derived class.
  std::function<void(std::string_view bytes)> read;
  /// Valid inputs, from which others are made.
  std::function<std::vector<std::string>()> samples;
};

// One function per file.
[[nodiscard]] std::vector<Target> message_targets();
[[nodiscard]] std::vector<Target> planner_file_targets();
[[nodiscard]] std::vector<Target> run_file_targets();
[[nodiscard]] std::vector<Target> datagram_targets();

[[nodiscard]] std::vector<Target> all_targets();

/// Calls `read`. An error that a reader may report is none; others pass.
void read(const Target& target, std::string_view bytes);

}  // namespace hlc::fuzz
