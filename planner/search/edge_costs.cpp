#include "planner/search/edge_costs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace hlc {
namespace {

const CriterionValue* find_value(const Maneuver& maneuver, const std::string& criterion) {
  const auto found = std::ranges::find(maneuver.criteria, criterion, &CriterionValue::name);
  return found == maneuver.criteria.end() ? nullptr : &*found;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none, the automaton holds no criteria" : text;
}

}  // namespace

std::vector<std::string> criteria_of(const Subgraph& subgraph) {
  const Edge& first = subgraph.successors(subgraph.starts().front()).front();
  std::vector<std::string> names;
  for (const CriterionValue& value : first.maneuver->criteria) names.push_back(value.name);
  for (const TrimId trim : subgraph.starts()) {
    for (const Edge& edge : subgraph.successors(trim)) {
      std::erase_if(names, [&edge](const std::string& name) {
        return find_value(*edge.maneuver, name) == nullptr;
      });
    }
  }
  return names;
}

EdgeCosts::EdgeCosts(const Subgraph& subgraph, const std::vector<PlanningWeight>& weights,
                     std::size_t max_steps)
    : weights_(weights) {
  if (weights_.empty()) return;
  const std::vector<std::string> known = criteria_of(subgraph);
  for (const auto& [criterion, weight_m2] : weights_) {
    if (std::ranges::find(known, criterion) == known.end()) {
      throw std::invalid_argument("criterion_weights: " + criterion + ", allowed " + joined(known));
    }
    if (!(weight_m2 >= 0.0 && weight_m2 <= SearchOptions::kMostWeight_m2)) {
      throw std::invalid_argument("criterion_weights: " + criterion + " = " +
                                  std::to_string(weight_m2) + ", allowed numbers from 0 to 1e9");
    }
  }
  least_ = std::numeric_limits<double>::infinity();
  for (const TrimId trim : subgraph.starts()) {
    for (const Edge& edge : subgraph.successors(trim)) {
      least_ = std::min(least_, weighted(*edge.maneuver));
    }
  }
  constexpr double kSurely = 1.0 - 1e-12;
  const std::size_t num_trims = subgraph.automaton().trims.size();
  to_go_.assign(max_steps + 1, std::vector<double>(num_trims, 0.0));
  for (std::size_t steps = 1; steps <= max_steps; ++steps) {
    for (const TrimId trim : subgraph.starts()) {
      double least = std::numeric_limits<double>::infinity();
      for (const Edge& edge : subgraph.successors(trim, steps)) {
        least = std::min(
            least, kSurely * (above_least(*edge.maneuver) + to_go_[steps - 1][edge.to.index]));
      }
      to_go_[steps][trim.index] = least;
    }
  }
}

double EdgeCosts::weighted(const Maneuver& maneuver) const {
  double cost = 0.0;
  for (const PlanningWeight& weight : weights_) {
    cost += weight.weight_m2 * find_value(maneuver, weight.criterion)->value;
  }
  return cost;
}

double EdgeCosts::above_least(const Maneuver& maneuver) const {
  return is_zero() ? 0.0 : weighted(maneuver) - least_;
}

double EdgeCosts::to_go(TrimId trim, std::size_t steps) const {
  if (is_zero()) return 0.0;
  assert(steps < to_go_.size());
  return to_go_[steps][trim.index];
}

}  // namespace hlc
