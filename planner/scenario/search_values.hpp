#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/common/node.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {

/// The value of a name.
/// @param from_name  throws std::invalid_argument for an unknown name
/// @param allowed    the known names
template <class FromName>
[[nodiscard]] auto read_named(const Node& node, const std::string& key, FromName from_name,
                              const std::string& allowed) {
  const auto name = node.required<std::string>(key);
  try {
    return from_name(name);
  } catch (const std::invalid_argument&) {
    node.fail(key, "one of " + allowed);
  }
}

/// Key `engine`, a name for choose_engine; may be absent.
[[nodiscard]] std::optional<std::string> read_engine(const Node& node);

/// Key `max_expansions`, which may be absent.
[[nodiscard]] std::size_t read_max_expansions(const Node& node);

/// Key `criterion_weights` of a file, {criterion: m^2 per unit}; may be absent.
/// check_criterion_weights checks the criteria.
[[nodiscard]] std::vector<search::PlanningWeight> read_criterion_weights(const Node& node);

/// @throws std::invalid_argument naming the place if the automaton does not have a criterion
void check_criterion_weights(const Node& node, const std::vector<search::PlanningWeight>& weights,
                             const automaton::Subgraph& subgraph);

}  // namespace hlc::scenario
