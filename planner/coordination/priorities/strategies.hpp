#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/coordination/priority.hpp"

namespace hlc::coordination {

// Each is described in its file, which has the strategy's name.
extern const PriorityStrategy kRandomPriorities;
extern const PriorityStrategy kMostCollisionsFirst;
extern const PriorityStrategy kColouringPriorities;
extern const PriorityStrategy kWaitingTimePriorities;
extern const PriorityStrategy kExplorativePriorities;
extern const PriorityStrategy kOptimalPriorities;
extern const PriorityStrategy kBestOrder;

/// All, kConstantPriorities first.
[[nodiscard]] std::span<const PriorityStrategy* const> priority_strategies();
/// nullptr: there is none of this name.
[[nodiscard]] const PriorityStrategy* priority_strategy(std::string_view name);
[[nodiscard]] std::vector<std::string> priority_strategy_names();

}  // namespace hlc::coordination
