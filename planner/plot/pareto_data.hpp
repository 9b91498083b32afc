#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner/maneuver_design/pareto_front.hpp"

namespace hlc::plot {

/// Description of the front for table and drawing.
struct ParetoDescription {
  automaton::Trim from;
  automaton::Trim to;
  double duration_s{};
  std::vector<std::string> criteria;  ///< names, in the order of the objectives
  std::optional<maneuver_design::DurationRange> free_duration{};  ///< instead of duration_s
};

/// The front of two criteria for the paper's Fig. 1, with the weighted sums for comparison:
///
///     {"from": [v, delta], "to": [v, delta], "duration_s": [least, largest],
///      "criteria": [first, second], "knee": index of a point,
///      "points": [{"objectives": [first, second], "is_converged", "duration_s",
///                  "states": [[x, y, psi, v], ...], "inputs": [[u_v, u_delta], ...]}, ...],
///      "weighted_sums": [[first, second], ...]}
///
/// Points from the optimum of the second criterion to that of the first.
/// @pre the front has points
[[nodiscard]] nlohmann::ordered_json pareto_data(const maneuver_design::ParetoFront& front,
                                                 const maneuver_design::ParetoFront& weighted_sums,
                                                 const ParetoDescription& description);

}  // namespace hlc::plot
