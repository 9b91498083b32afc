#pragma once

#include <span>
#include <string>
#include <string_view>

#include "planner/search/horizon_problem.hpp"

namespace hlc::scenario {

/// An engine by its name in scenarios, problem files and command lines.
struct NamedEngine {
  std::string_view name;
  search::Engine engine;
  search::EngineFactory factory;  ///< nullptr: `engine` itself
};

/// All. A further engine is one more entry.
///
/// | name                    | what plans                                                     |
/// |-------------------------|----------------------------------------------------------------|
/// | `branch_and_bound`      | Engine::kBranchAndBound                                        |
/// | `best_first`            | Engine::kBestFirst                                             |
/// | `ompl_branch_and_bound` | the same engines, called through `ompl::base::Planner`         |
/// | `ompl_best_first`       | (make_ompl_engine): the same plans and counts, a little slower |
[[nodiscard]] std::span<const NamedEngine> engines();
/// Their names, separated by ", ".
[[nodiscard]] std::string engine_choices();

/// Sets `engine` and `factory`.
/// @throws std::invalid_argument, "engine = NAME, must be ...", for any other name
void choose_engine(const std::string& name, search::SearchOptions& search);

/// The name for which `choose_engine` gives these options; with a factory that is not listed the
/// name of `engine`.
[[nodiscard]] std::string engine_name(const search::SearchOptions& search);

}  // namespace hlc::scenario
