#pragma once

#include <string>

namespace hlc {

/// The shortest decimal text that reads back (std::from_chars, or any correct reader) to the same
/// bits; nan and inf as such.
[[nodiscard]] std::string shortest_text(double value);

/// The text in double quotes, so that any text without control characters reads back from YAML.
[[nodiscard]] std::string quoted_yaml(const std::string& text);

}  // namespace hlc
