#pragma once

#include <ompl/base/Path.h>
#include <ompl/base/Planner.h>
#include <ompl/base/ScopedState.h>

#include <memory>
#include <string>

#include "planner/automaton/subgraph.hpp"
#include "planner/search/ompl/ompl_problem.hpp"
#include "planner/search/search_engine.hpp"

namespace hlc::search {

/// Solves problem definitions whose goal is a StandstillGoal (a HorizonProblemDefinition has one)
/// with a search engine. Usable from any OMPL program, for example
///
///     const Subgraph subgraph = ...;                // what the vehicle can do
///     const HorizonProblem problem = ...;
///     const ReachableSets reachable(subgraph, problem.horizon_steps());
///     const auto si = make_space_information(subgraph, problem.horizon_steps());
///     RecedingHorizonPlanner planner(si, subgraph, reachable, {});
///     planner.setProblemDefinition(
///         std::make_shared<HorizonProblemDefinition>(si, subgraph, problem));
///     planner.params().setParam("engine", "branch_and_bound");
///     const ompl::base::PlannerStatus status = planner.solve(1.0);  // seconds
///
/// and planner/apps/ompl_example.cpp. `solve` checks the termination condition regularly between
/// expansions and returns
///
/// | status                 | meaning                                                      |
/// |------------------------|--------------------------------------------------------------|
/// | EXACT_SOLUTION         | a path; the definition gets it with its cost, "optimized" if |
/// |                        | SearchStatus::kOptimal                                       |
/// | APPROXIMATE_SOLUTION   | the best path ends outside the goal's radius                 |
/// | ABORT                  | no path exists; it gets a SolutionNonExistenceProof          |
/// | TIMEOUT                | budget used up, or terminated, before a path was found       |
/// | INVALID_START          | start states are not the problem's one start                 |
/// | UNRECOGNIZED_GOAL_TYPE | the goal is not a StandstillGoal                             |
///
/// The path has n + 1 states: a control::PathControl of n edges if the space information is one of
/// ompl_control.hpp, otherwise a geometric::PathGeometric. Each `solve` searches from the
/// beginning.
///
/// Parameters (`params()`), all as text; a value out of range is refused (setParam returns false).
/// They take effect at the next `solve`:
///
/// | name           | allowed                                            |
/// |----------------|----------------------------------------------------|
/// | engine         | branch_and_bound, best_first                       |
/// | cost_to_go     | reachable; with best_first straight_line and 2022  |
/// | max_expansions | whole numbers from 1                               |
class RecedingHorizonPlanner final : public ompl::base::Planner {
 public:
  /// @param si  of make_space_information or make_control_space_information for this subgraph
  /// @param subgraph, reachable  must outlive the planner; `reachable` for at least the horizon
  /// @param options  `factory` is ignored: the engine behind this planner is `engine`
  /// @param tables  as make_search_engine; used until a parameter changes
  RecedingHorizonPlanner(const ompl::base::SpaceInformationPtr& si,
                         const automaton::Subgraph& subgraph,
                         const automaton::ReachableSets& reachable, const SearchOptions& options,
                         std::shared_ptr<const SearchTables> tables = nullptr);

  /// @throws std::invalid_argument as make_search_engine, if the parameters do not match; so does
  /// the next `solve`
  void setup() override;
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  using ompl::base::Planner::solve;
  void clear() override;
  /// Drops the result of another definition.
  void setProblemDefinition(const ompl::base::ProblemDefinitionPtr& definition) override;

  /// The path of the last `solve`: a vertex for each of its states, the first a start vertex, the
  /// last a goal vertex; an edge for each step with its term of the cost, and with its control if
  /// `data` has controls. Nothing without a path: the rest of the search tree is not kept. States
  /// belong to the planner until its next `solve` or `clear`.
  void getPlannerData(ompl::base::PlannerData& data) const override;

  [[nodiscard]] const SearchOptions& options() const { return options_; }

  /// The engine's result of the last `solve`, with maneuvers and counts.
  [[nodiscard]] const SearchResult& result() const { return result_; }
  /// The same, moved out; `result` is empty (infeasible) afterwards.
  [[nodiscard]] SearchResult take_result();

 private:
  void declare_parameters();
  void forget();
  [[nodiscard]] bool starts_where_problem_starts(const HorizonProblem& problem);
  ompl::base::PlannerStatus add_solution(const HorizonProblem& problem);

  const automaton::Subgraph& subgraph_;
  const automaton::ReachableSets& reachable_;
  SearchOptions options_;
  std::shared_ptr<const SearchTables> tables_;
  std::unique_ptr<SearchEngine> engine_;
  SearchResult result_;
  ompl::base::ScopedState<> state_;  ///< for queries about one state: making one takes long
  ompl::base::PathPtr path_;
  ompl::base::PathPtr former_path_;  ///< to be overwritten, if it has no other owner
};

}  // namespace hlc::search
