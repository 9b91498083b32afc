#pragma once

#include <optional>
#include <string>

#include "planner/common/node.hpp"
#include "planner/scenario/profile.hpp"

namespace hlc::scenario {

/// Names of rules in a scenario; none: the profile's. Priorities are in priority_values.hpp.
///
/// | key                  | registry                          |
/// |----------------------|-----------------------------------|
/// | `coordination`       | controller/coordination_rules.hpp |
/// | `coupling`           | coordination/coupling_rule.hpp    |
/// | `reference_rule`     | road/reference_points.hpp         |
/// | `right_of_way_order` | right_of_way/grant_order.hpp      |
struct StrategyValues {
  std::optional<std::string> coordination{};
  std::optional<std::string> coupling{};
  std::optional<std::string> reference_rule{};
  std::optional<std::string> right_of_way_order{};
};

/// @param node  the scenario
/// @throws std::invalid_argument for a name that the key's registry does not have
[[nodiscard]] StrategyValues read_strategies(const Node& node);

/// Replaces the profile's rules by the named ones.
void choose_strategies(const StrategyValues& values, Profile& profile);

}  // namespace hlc::scenario
