#pragma once

#include <nlohmann/json.hpp>

#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/scenario/joint_problem_file.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::plot {

/// A planning problem and its plan:
///
///     {"subgraph", "horizon_steps", "step_s", "status", "reason", "cost_m2",
///      "footprint": {"length_m", "width_m"},                  without margin
///      "vehicles": [{"start": [x, y, psi], "reference": [[x, y], ...],
///                    "boundary": [[[x, y], [x, y]], ...],
///                    "obstacles": [[polygon, ...], ...],      of each step
///                    "poses": [[x, y, psi], ...],             after each step; [] without a plan
///                    "swept": [polygon, ...]}]}               of each step, likewise
///
/// status and reason as search::to_string.
/// @param result  may be without a plan
[[nodiscard]] nlohmann::ordered_json problem_data(const scenario::ProblemFile& file,
                                                  const search::SearchResult& result);

/// The same of vehicles that are planned jointly.
[[nodiscard]] nlohmann::ordered_json problem_data(const scenario::JointProblemFile& file,
                                                  const joint_search::JointSearchResult& result);

}  // namespace hlc::plot
