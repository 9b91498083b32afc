#include "planner/coordination/priorities/strategies.hpp"

#include <algorithm>
#include <array>

namespace hlc::coordination {

std::span<const PriorityStrategy* const> priority_strategies() {
  static constexpr std::array kAll{
      &kConstantPriorities,    &kRandomPriorities,
      &kMostCollisionsFirst,   &kColouringPriorities,
      &kWaitingTimePriorities, &kExplorativePriorities,
      &kOptimalPriorities,     &kBestOrder,
  };
  return kAll;
}

const PriorityStrategy* priority_strategy(std::string_view name) {
  const auto all = priority_strategies();
  const auto found = std::ranges::find(all, name, &PriorityStrategy::name);
  return found == all.end() ? nullptr : *found;
}

std::vector<std::string> priority_strategy_names() {
  std::vector<std::string> names;
  for (const PriorityStrategy* one : priority_strategies()) names.emplace_back(one->name);
  return names;
}

}  // namespace hlc::coordination
