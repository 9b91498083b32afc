#include "planner/scenario/priority_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "planner/coordination/priorities/strategies.hpp"

namespace hlc::scenario {
namespace {

constexpr double kMostLevels = 100.0;
constexpr const char* kKey = "priorities";

const coordination::PriorityStrategy* read_strategy(const Node& node, const char* key) {
  if (!node.has(key)) return &coordination::kConstantPriorities;
  return coordination::priority_strategy(
      node.required<std::string>(key, one_of(coordination::priority_strategy_names())));
}

std::vector<VehicleId> read_first(const Node& node) {
  std::vector<VehicleId> first;
  if (!node.has("first")) return first;
  for (const Node& entry : node.list("first")) {
    const VehicleId id{
        static_cast<std::uint8_t>(entry.as<std::size_t>(between(1.0, kMaxVehicleId)))};
    if (std::ranges::find(first, id) != first.end())
      entry.fail("an id that is not yet in the list");
    first.push_back(id);
  }
  return first;
}

std::vector<std::string_view> strategies_without_search() {
  std::vector<std::string_view> names;
  for (const coordination::PriorityStrategy* one : coordination::priority_strategies()) {
    if (one->search == nullptr) names.push_back(one->name);
  }
  return names;
}

}  // namespace

coordination::PriorityRule read_priorities(const Node& node) {
  coordination::PriorityRule rule;
  if (node.is_value(kKey)) {
    rule.strategy = read_strategy(node, kKey);
    return rule;
  }
  if (!node.has(kKey)) return rule;
  if (node.is_list(kKey)) node.fail(kKey, "the name of a strategy or a map");
  const Node values = node.map(kKey);
  rule.strategy = read_strategy(values, "strategy");
  rule.first = read_first(values);
  rule.max_levels = values.optional<std::size_t>("max_levels", 0, between(1.0, kMostLevels));
  rule.beyond = read_strategy(values, "beyond");
  const bool is_constant = rule.beyond == &coordination::kConstantPriorities;
  const bool is_unlimited = rule.beyond->search != nullptr && rule.beyond->most_vehicles == 0;
  if (!is_constant && !is_unlimited) values.fail("beyond", "constant, explorative or best_order");
  values.check_no_unknown_keys();
  return rule;
}

const coordination::PriorityStrategy* priority_strategy_from_flag(const std::string& name) {
  if (const auto* const strategy = coordination::priority_strategy(name)) return strategy;
  throw std::invalid_argument(
      fmt::format("--priorities = {}, must be one of {}", name,
                  fmt::join(coordination::priority_strategy_names(), ", ")));
}

std::string unsuitable_priorities(const coordination::PriorityRule& priorities,
                                  const controller::CoordinationRule& coordination) {
  if (!coordination.commit.needs_votes) return "";
  if (priorities.strategy->search != nullptr) {
    return fmt::format("one of {} {}", fmt::join(strategies_without_search(), ", "), kWithVotes);
  }
  return priorities.max_levels == 0 ? "" : fmt::format("without max_levels {}", kWithVotes);
}

std::string priority_strategies_text() {
  std::string text;
  for (const coordination::PriorityStrategy* one : coordination::priority_strategies()) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", one->name, one->meaning);
  }
  return text;
}

}  // namespace hlc::scenario
