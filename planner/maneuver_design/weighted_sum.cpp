#include "planner/maneuver_design/weighted_sum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hlc::maneuver_design {

double WeightedSum::value(const vehicle::StateVector& x, const vehicle::Input& u) const {
  double sum = 0.0;
  for (const WeightedCost& term : terms_) {
    sum += term.weight * term.cost->value(x, u);
  }
  return sum;
}

CostGradient WeightedSum::gradient(const vehicle::StateVector& x, const vehicle::Input& u) const {
  CostGradient sum;
  for (const WeightedCost& term : terms_) {
    const CostGradient gradient = term.cost->gradient(x, u);
    sum.state += term.weight * gradient.state;
    sum.input += term.weight * gradient.input;
  }
  return sum;
}

bool WeightedSum::depends_on_pose() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const WeightedCost& term) {
    return term.weight != 0.0 && term.cost->depends_on_pose();
  });
}

bool WeightedSum::has_many_optima() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const WeightedCost& term) {
    return term.weight != 0.0 && term.cost->has_many_optima();
  });
}

WeightedSum normalised_sum(std::vector<WeightedCost> terms,
                           const std::vector<CriterionRange>& ranges) {
  if (terms.size() != ranges.size()) {
    throw std::invalid_argument(
        fmt::format("ranges = {}, must be one per criterion: {}", ranges.size(), terms.size()));
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double width = ranges[i].worst - ranges[i].best;
    if (!(width > 0.0)) {
      throw std::invalid_argument(
          fmt::format("range of criterion {} = {:f}, must be > 0", i + 1, width));
    }
    terms[i].weight /= width;
  }
  return WeightedSum(std::move(terms));
}

}  // namespace hlc::maneuver_design
