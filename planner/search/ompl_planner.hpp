#pragma once

#include <ompl/base/Planner.h>

#include <memory>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/ompl_problem.hpp"
#include "planner/search/planner.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc {

/// Solves HorizonProblemDefinitions with a search engine.
///
/// `solve` asks the termination condition between expansions and returns
///
/// | status                 | meaning                                                      |
/// |------------------------|--------------------------------------------------------------|
/// | EXACT_SOLUTION         | a path; the definition gets a PathGeometric of n + 1 states  |
/// |                        | with its cost, "optimized" if SearchStatus::kOptimal         |
/// | ABORT                  | no path exists; it gets a SolutionNonExistenceProof          |
/// | TIMEOUT                | budget used up, or terminated, before a path was found       |
/// | INVALID_START          | start states are not the problem's one start                 |
/// | UNRECOGNIZED_GOAL_TYPE | not a HorizonProblemDefinition                               |
///
/// Each `solve` searches from the beginning.
class RecedingHorizonPlanner final : public ompl::base::Planner {
 public:
  RecedingHorizonPlanner(const ompl::base::SpaceInformationPtr& si,
                         std::unique_ptr<SearchEngine> engine);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  using ompl::base::Planner::solve;
  void clear() override;

  /// What the engine found in the last `solve`, with maneuvers and counts.
  [[nodiscard]] const SearchResult& result() const { return result_; }
  /// The same, moved out; `result` is empty (infeasible) afterwards.
  [[nodiscard]] SearchResult take_result();

 private:
  [[nodiscard]] bool starts_where_problem_starts(const HorizonProblem& problem) const;
  void add_solution(const HorizonProblem& problem);

  std::unique_ptr<SearchEngine> engine_;
  SearchResult result_;
};

/// A HorizonPlanner that plans with `engine` through a RecedingHorizonPlanner; never timed.
/// @param subgraph   must outlive the planner
/// @param max_steps  longest horizon
[[nodiscard]] std::unique_ptr<HorizonPlanner> make_ompl_horizon_planner(
    const Subgraph& subgraph, std::size_t max_steps, std::unique_ptr<SearchEngine> engine);

}  // namespace hlc
