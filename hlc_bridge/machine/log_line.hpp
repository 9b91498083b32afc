#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace hlc::machine {

enum class Severity : std::uint8_t { kInfo, kWarning, kError };

/// A line for the log of the process; without the process's name, which the shell adds.
struct LogLine {
  Severity severity{Severity::kInfo};
  std::string text;
  friend bool operator==(const LogLine&, const LogLine&) = default;
};

[[nodiscard]] inline LogLine info(std::string text) { return {Severity::kInfo, std::move(text)}; }
[[nodiscard]] inline LogLine warning(std::string text) {
  return {Severity::kWarning, std::move(text)};
}
[[nodiscard]] inline LogLine error(std::string text) { return {Severity::kError, std::move(text)}; }

/// "a, b, c".
template <class Names>
[[nodiscard]] std::string joined(const Names& names) {
  std::string line;
  for (const auto& name : names) {
    if (!line.empty()) line += ", ";
    if constexpr (requires { line += std::to_string(name); }) {
      line += std::to_string(name);
    } else {
      line += name;
    }
  }
  return line;
}

}  // namespace hlc::machine
