#pragma once

#include <string>

#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// The names of engines, costs-to-go and statuses in flags and files.
///
/// | Engine          | CostToGo      | SearchStatus | NoPath     |
/// |-----------------|---------------|--------------|------------|
/// | branch_and_bound| reachable     | optimal      | none       |
/// | best_first      | straight_line | budget       | infeasible |
/// |                 | 2022          | fallback     | budget     |
[[nodiscard]] const char* to_string(Engine engine);
[[nodiscard]] const char* to_string(CostToGo cost_to_go);
[[nodiscard]] const char* to_string(SearchStatus status);
[[nodiscard]] const char* to_string(NoPath reason);

/// True if it is a lower bound of the remaining cost, so that a plan found with it is optimal.
[[nodiscard]] bool is_admissible(CostToGo cost_to_go);
/// True if it needs HorizonProblem::reference_speed_mps.
[[nodiscard]] bool needs_reference_speeds(CostToGo cost_to_go);

/// All names, separated by ", ".
inline constexpr char kEngineNames[] = "branch_and_bound, best_first";
inline constexpr char kCostToGoNames[] = "reachable, straight_line, 2022";

/// @throws std::invalid_argument, "engine = NAME, must be ...", for any other name
[[nodiscard]] Engine engine_from_name(const std::string& name);
/// @throws std::invalid_argument, "cost_to_go = NAME, must be ...", for any other name
[[nodiscard]] CostToGo cost_to_go_from_name(const std::string& name);

/// Branch and bound searches with `kReachable` only.
/// @throws std::invalid_argument with one line if the engine does not support that cost-to-go, or
/// max_expansions is 0
void check_search_options(const SearchOptions& options);

}  // namespace hlc::search
