#pragma once

#include <string>

#include "planner/search/horizon_problem.hpp"

namespace hlc::scenario {

/// The names of the engines in scenarios, problem files and command lines.
///
/// | name                    | what plans                                                     |
/// |-------------------------|----------------------------------------------------------------|
/// | `branch_and_bound`      | Engine::kBranchAndBound                                        |
/// | `best_first`            | Engine::kBestFirst                                             |
/// | `ompl_branch_and_bound` | the same engines, called through `ompl::base::Planner`         |
/// | `ompl_best_first`       | (make_ompl_engine): the same plans and counts, a little slower |
inline constexpr char kEngineChoices[] =
    "branch_and_bound, best_first, ompl_branch_and_bound, ompl_best_first";

/// Sets `engine` and `factory`.
/// @throws std::invalid_argument, "engine = NAME, must be ...", for any other name
void choose_engine(const std::string& name, search::SearchOptions& search);

/// The name for which `choose_engine` gives these options; with another factory the name of
/// `engine`.
[[nodiscard]] std::string engine_name(const search::SearchOptions& search);

}  // namespace hlc::scenario
