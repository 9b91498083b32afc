#pragma once

#include <string>

#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/scenario/joint_problem_file.hpp"

namespace hlc::apps {

/// The solution of a joint problem, and what planning one after the other would give.
struct JointSolution {
  joint_search::JointPlan alone;           ///< without each other; empty: one has no plan
  joint_search::JointPlan constant_order;  ///< the first vehicle of the file first; may be empty
  joint_search::JointPlan best_order;      ///< of all orders; may be empty
  joint_search::JointSearchResult joint;
  double planning_us{};  ///< of `joint`, from the best order on
};

/// @throws std::invalid_argument if the file's search has an inadmissible cost-to-go
[[nodiscard]] JointSolution solve(const scenario::JointProblemFile& file,
                                  const joint_search::JointSearchOptions& options);

/// One JSON object, a line: status, reason, cost, lower_bound, gap [m^2], alone, constant_order,
/// best_order (costs, null without a plan), vehicles ({cost, trims, poses} each), nodes, expanded,
/// planning_us.
[[nodiscard]] std::string json_of(const JointSolution& solution);

void print(const scenario::JointProblemFile& file, const JointSolution& solution);

}  // namespace hlc::apps
