#pragma once

#include <string>

#include "planner/common/node.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/coordination/priority.hpp"

namespace hlc::scenario {

/// Key `priorities` of a scenario: the name of a strategy, or
///
///     strategy    name (coordination/priorities/strategies.hpp); default constant
///     first       ids of vehicles that plan before all others, in this order; default none
///     max_levels  no more computation levels, 1 to 100; default: no limit
///     beyond      constant (default), explorative or best_order: for components with more
///                 vehicles than the strategy can compare
///
/// @param node  the scenario; the key may be absent: constant priorities
[[nodiscard]] coordination::PriorityRule read_priorities(const Node& node);

/// For --priorities. @throws std::invalid_argument for an unknown name
[[nodiscard]] const coordination::PriorityStrategy* priority_strategy_from_flag(
    const std::string& name);

/// For messages.
inline constexpr const char* kWithVotes = "with coordination: agreed (that of profile 2022)";

/// "" if plans stay free of each other under these priorities and this rule, otherwise what the
/// priorities must be. Votes alone keep vehicles apart only if one of each coupled pair plans
/// around the other; and they leave no time to compare orders.
[[nodiscard]] std::string unsuitable_priorities(const coordination::PriorityRule& priorities,
                                                const controller::CoordinationRule& coordination);

/// One line for each strategy: name and meaning.
[[nodiscard]] std::string priority_strategies_text();

}  // namespace hlc::scenario
