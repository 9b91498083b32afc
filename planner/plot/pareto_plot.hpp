#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/maneuver_design/pareto_front.hpp"

namespace hlc::plot {

/// Description of the front for table and plot.
struct ParetoDescription {
  automaton::Trim from;
  automaton::Trim to;
  double duration_s{};
  std::vector<std::string> criteria;  ///< names, in the order of the objectives
  std::optional<maneuver_design::DurationRange> free_duration{};  ///< instead of duration_s
};

/// The paper's Fig. 1 for two criteria: the front with its knee and, for comparison, the weighted
/// sums; positions, orientations, speeds and both inputs over time, coloured along the front from
/// red (optimum of the second criterion: soft inputs for J2) to blue (optimum of the first).
[[nodiscard]] std::string pareto_plot(const maneuver_design::ParetoFront& front,
                                      const maneuver_design::ParetoFront& weighted_sums,
                                      const ParetoDescription& description);

}  // namespace hlc::plot
