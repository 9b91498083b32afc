#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

namespace hlc::campaign {

/// A number of a table with this many decimals.
[[nodiscard]] inline std::string number(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

/// The same of a value that may be absent.
[[nodiscard]] inline std::string number(const std::optional<double>& value, int decimals,
                                        const char* absent) {
  return value ? number(*value, decimals) : absent;
}

}  // namespace hlc::campaign
