#pragma once

#include <string>

#include "planner/joint_search/joint_solution.hpp"
#include "planner/scenario/joint_problem_file.hpp"

namespace hlc::apps {

/// A solution, and the time that it took.
struct TimedSolution {
  joint_search::JointSolution solution;
  double planning_us{};  ///< of all of it
};

/// @throws std::invalid_argument as joint_search::solve
[[nodiscard]] TimedSolution solve(const scenario::JointProblemFile& file,
                                  const joint_search::JointSearchOptions& options);

/// One JSON object, a line: status, reason, cost, lower_bound, gap [m^2], alone, constant_order,
/// best_order (costs, null without a plan), vehicles ({cost, trims, poses} each), nodes, expanded,
/// planning_us.
[[nodiscard]] std::string json_of(const TimedSolution& timed);

void print(const scenario::JointProblemFile& file, const TimedSolution& timed);

}  // namespace hlc::apps
