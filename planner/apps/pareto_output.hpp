#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/apps/svg_plot.hpp"
#include "planner/maneuver_design/pareto_front.hpp"

namespace hlc {

/// What the outputs say beside the front itself.
struct ParetoDescription {
  Trim from;
  Trim to;
  double duration_s{};
  std::vector<std::string> criteria;             ///< names, in the order of the objectives
  std::optional<DurationRange> free_duration{};  ///< instead of duration_s
};

/// One row per point, in the order of the front. Columns: the criteria by name, dx [m], dy [m],
/// dpsi [rad] (end pose in the frame of the start), status (optimal or not_converged), duration [s]
/// if it is free, v_max [m/s], dominated and knee (0 or 1), first_order_residual. Numbers with 17
/// digits, so that they read back exactly.
[[nodiscard]] std::string csv_of(const ParetoFront& front, const ParetoDescription& description);

/// The paper's Fig. 1 for two criteria: the front with its knee and, for comparison, the weighted
/// sums; positions, orientations, speeds and both inputs over time, coloured along the front from
/// red (optimum of the second criterion: soft inputs for J2) to blue (optimum of the first).
[[nodiscard]] std::string svg_of(const ParetoFront& front, const ParetoFront& weighted_sums,
                                 const ParetoDescription& description);

}  // namespace hlc
