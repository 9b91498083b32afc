#include "planner/search/edge_costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <string>

namespace hlc::search {
namespace {

const CriterionValue* find_value(const automaton::Maneuver& maneuver,
                                 const std::string& criterion) {
  const auto found = std::ranges::find(maneuver.criteria, criterion, &CriterionValue::name);
  return found == maneuver.criteria.end() ? nullptr : &*found;
}

void check_weights(const std::vector<PlanningWeight>& weights,
                   const std::vector<std::string>& known) {
  for (const auto& [criterion, weight_m2] : weights) {
    if (std::ranges::find(known, criterion) == known.end()) {
      const std::string names = known.empty() ? "none, the automaton holds no criteria"
                                              : fmt::format("{}", fmt::join(known, ", "));
      throw std::invalid_argument(
          fmt::format("criterion_weights: {}, must be one of {}", criterion, names));
    }
    if (!(weight_m2 >= 0.0 && weight_m2 <= SearchOptions::kMostWeight_m2)) {
      throw std::invalid_argument(
          fmt::format("criterion_weights: {} = {:f}, must be in 0 ... 1e9", criterion, weight_m2));
    }
  }
}

}  // namespace

std::vector<std::string> criteria_of(const automaton::Subgraph& subgraph) {
  const automaton::Edge& first = subgraph.successors(subgraph.start_trims().front()).front();
  std::vector<std::string> names;
  for (const CriterionValue& value : first.maneuver->criteria) names.push_back(value.name);
  for (const TrimId trim : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      std::erase_if(names, [&edge](const std::string& name) {
        return find_value(*edge.maneuver, name) == nullptr;
      });
    }
  }
  return names;
}

EdgeCosts::EdgeCosts(const automaton::Subgraph& subgraph,
                     const std::vector<PlanningWeight>& weights, std::size_t max_steps)
    : weights_(weights) {
  if (weights_.empty()) return;
  check_weights(weights_, criteria_of(subgraph));
  least_ = std::numeric_limits<double>::infinity();
  for (const TrimId trim : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(trim)) {
      least_ = std::min(least_, weighted(*edge.maneuver));
    }
  }
  const std::size_t num_trims = subgraph.automaton().trims.size();
  to_go_.assign(max_steps + 1, std::vector<double>(num_trims, 0.0));
  for (std::size_t steps = 1; steps <= max_steps; ++steps) {
    for (const TrimId trim : subgraph.start_trims()) {
      to_go_[steps][trim.index] = least_to_go(subgraph.successors(trim, steps), to_go_[steps - 1]);
    }
  }
}

double EdgeCosts::least_to_go(std::span<const automaton::Edge> edges,
                              const std::vector<double>& after_edge) const {
  constexpr double kSurely = 1.0 - 1e-12;
  double least = std::numeric_limits<double>::infinity();
  for (const automaton::Edge& edge : edges) {
    least = std::min(least, kSurely * (reduced_cost(*edge.maneuver) + after_edge[edge.to.index]));
  }
  return least;
}

double EdgeCosts::weighted(const automaton::Maneuver& maneuver) const {
  double cost = 0.0;
  for (const PlanningWeight& weight : weights_) {
    cost += weight.weight_m2 * find_value(maneuver, weight.criterion)->value;
  }
  return cost;
}

double EdgeCosts::reduced_cost(const automaton::Maneuver& maneuver) const {
  return is_zero() ? 0.0 : weighted(maneuver) - least_;
}

double EdgeCosts::to_go(TrimId trim, std::size_t steps) const {
  if (is_zero()) return 0.0;
  assert(steps < to_go_.size());  // per vertex
  return to_go_[steps][trim.index];
}

}  // namespace hlc::search
