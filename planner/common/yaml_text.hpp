#pragma once

#include <cstddef>
#include <string>

namespace hlc {

/// The shortest decimal text that reads back (std::from_chars, or any correct reader) to the same
/// bits; nan and inf as such.
[[nodiscard]] std::string shortest_text(double value);

/// The text in double quotes, so that any text without control characters reads back from YAML.
[[nodiscard]] std::string quoted_yaml(const std::string& text);

[[nodiscard]] bool has_control_characters(const std::string& text);

/// Line breaks and other control characters escaped as in C.
[[nodiscard]] std::string escaped(const std::string& text);

/// The text as shown in messages: one line, escaped, and cut after `longest` bytes (never within a
/// character) with `...`.
[[nodiscard]] std::string one_line(const std::string& text, std::size_t longest = 60);

}  // namespace hlc
