#pragma once

#include <map>
#include <string>
#include <string_view>

#include "planner/controller/controller_options.hpp"

namespace hlc::controller {

/// The coordination rules by name: `cooperative`, `strict` (the same without making room),
/// `agreed`. A further rule is one more entry.
[[nodiscard]] const std::map<std::string, CoordinationRule>& coordination_rules();

/// "other" if it is none of them.
[[nodiscard]] std::string_view name_of(const CoordinationRule& rule);

}  // namespace hlc::controller
