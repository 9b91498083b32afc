#include "planner/scenario/search_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/scenario/engine_choice.hpp"
#include "planner/search/edge_costs.hpp"

namespace hlc::scenario {

std::optional<std::string> read_engine(const Node& node) {
  if (!node.has("engine")) return std::nullopt;
  const auto known = [](const std::string& name) {
    search::SearchOptions search;
    choose_engine(name, search);
    return name;
  };
  return read_named(node, "engine", known, engine_choices());
}

std::size_t read_max_expansions(const Node& node) {
  return node.optional<std::size_t>(
      "max_expansions", search::SearchOptions{}.max_expansions,
      between(1.0, static_cast<double>(search::SearchOptions::kMostExpansions)));
}

std::vector<search::PlanningWeight> read_criterion_weights(const Node& node) {
  const Node map = node.optional_map("criterion_weights");
  std::vector<search::PlanningWeight> weights;
  for (const std::string& criterion : map.keys()) {
    weights.push_back(
        {criterion,
         map.required<double>(criterion, between(0.0, search::SearchOptions::kMostWeight_m2))});
  }
  return weights;
}

void check_criterion_weights(const Node& node, const std::vector<search::PlanningWeight>& weights,
                             const automaton::Subgraph& subgraph) {
  const std::vector<std::string> known = search::criteria_of(subgraph);
  for (const search::PlanningWeight& weight : weights) {
    if (std::ranges::find(known, weight.criterion) != known.end()) continue;
    node.map("criterion_weights")
        .fail(weight.criterion,
              fmt::format("criteria of the automaton's maneuvers: {}", fmt::join(known, " ")));
  }
}

}  // namespace hlc::scenario
