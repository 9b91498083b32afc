#pragma once

#include <cstdio>
#include <string>

namespace hlc::campaign {

/// A number of a table with this many decimals; |value| < 1e40.
[[nodiscard]] inline std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

}  // namespace hlc::campaign
