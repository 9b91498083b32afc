#pragma once

#include <string>

namespace hlc {

/// The text as a field of comma-separated values: in quotes, its own quotes doubled, if it needs
/// them.
[[nodiscard]] inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

}  // namespace hlc
