#pragma once

#include <memory>
#include <vector>

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// One term of a weighted sum.
struct WeightedCost {
  double weight{};
  std::shared_ptr<const RunningCost> cost;
};

/// l = sum_i w_i l_i: plain weighted sum of criteria, such as the paper's J3 = 0.5 J1 + 0.5 J2.
///
/// The terms keep their units: J3 is J2 in effect, since |J1| is about 3e-3 m^2 s and J2 about 1.
class WeightedSum final : public RunningCost {
 public:
  explicit WeightedSum(std::vector<WeightedCost> terms) : terms_(std::move(terms)) {}

  [[nodiscard]] double value(const vehicle::StateVector& x, const vehicle::Input& u) const override;
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override;
  [[nodiscard]] bool depends_on_pose() const override;
  [[nodiscard]] bool has_many_optima() const override;

 private:
  std::vector<WeightedCost> terms_;
};

/// Range of a criterion over a Pareto front.
struct CriterionRange {
  double best{};
  double worst{};
};

/// Weighted sum of criteria that are scaled by their ranges: w_i / (worst_i - best_i) in place of
/// w_i, so that equal weights are a true compromise. Up to a constant, which does not change the
/// optimum, this is sum_i w_i (J_i - best_i) / (worst_i - best_i).
///
/// @throws std::invalid_argument if sizes differ, or a range is not positive (criteria without
/// conflict have no front to choose from)
[[nodiscard]] WeightedSum normalised_sum(std::vector<WeightedCost> terms,
                                         const std::vector<CriterionRange>& ranges);

}  // namespace hlc::maneuver_design
