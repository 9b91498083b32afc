#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace hlc {

/// A number of a file, which holds null where there is none.
[[nodiscard]] inline std::optional<double> number_or_none(const nlohmann::ordered_json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

}  // namespace hlc
