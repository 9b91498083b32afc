#include "planner/scenario/strategy_values.hpp"

#include <utility>
#include <vector>

#include "planner/controller/coordination_rules.hpp"
#include "planner/coordination/coupling_rule.hpp"
#include "planner/right_of_way/grant_order.hpp"
#include "planner/road/reference_points.hpp"

namespace hlc::scenario {
namespace {

std::vector<std::string> coordination_names() {
  std::vector<std::string> names;
  for (const auto& [name, rule] : controller::coordination_rules()) names.push_back(name);
  return names;
}

std::vector<std::string> reference_rule_names() {
  std::vector<std::string> names;
  for (const road::NamedReferenceRule& one : road::reference_rules()) names.emplace_back(one.name);
  return names;
}

std::optional<std::string> read_name(const Node& node, const std::string& key,
                                     std::vector<std::string> known) {
  if (!node.has(key)) return std::nullopt;
  return node.required<std::string>(key, one_of(std::move(known)));
}

}  // namespace

StrategyValues read_strategies(const Node& node) {
  return {.coordination = read_name(node, "coordination", coordination_names()),
          .coupling = read_name(node, "coupling", coordination::coupling_rule_names()),
          .reference_rule = read_name(node, "reference_rule", reference_rule_names()),
          .right_of_way_order =
              read_name(node, "right_of_way_order", right_of_way::grant_order_names())};
}

void choose_strategies(const StrategyValues& values, Profile& profile) {
  controller::ControllerStrategies& strategies = profile.strategies;
  if (values.coordination) {
    strategies.coordination = controller::coordination_rules().at(*values.coordination);
  }
  if (values.coupling) strategies.coupling = coordination::coupling_rule(*values.coupling);
  if (values.reference_rule) profile.reference_rule = road::reference_rule(*values.reference_rule);
  if (values.right_of_way_order) {
    strategies.grant_order = right_of_way::grant_order(*values.right_of_way_order);
  }
}

}  // namespace hlc::scenario
