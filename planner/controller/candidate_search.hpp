#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "planner/controller/engine_cache.hpp"
#include "planner/controller/plan_in_force.hpp"
#include "planner/coordination/report.hpp"
#include "planner/search/horizon_problem.hpp"
#include "planner/vehicle/lab_limits.hpp"

namespace hlc::controller {

/// Constraints on a new plan. Not owned.
struct CandidateInputs {
  const PlanInForce& in_force;                   ///< continued by the new plan
  StepIndex now;                                 ///< k; the plan is new from t(k+1) on
  const ConvexPolygon& reachable_area_m;         ///< as announced in this step's traffic
  const std::optional<vehicle::LabLimits>& lab;  ///< limits of the vehicle; absent: none
  std::size_t budget_share{1};  ///< a search may use one expansion in so many of its budget
};

/// A problem, the subgraph that it was searched on, and how far.
struct SearchedProblem {
  search::HorizonProblem problem;
  std::shared_ptr<const automaton::Subgraph> subgraph;
  std::size_t max_expansions{};
};

/// Result of the search for a new plan.
struct PlanCandidate {
  std::optional<coordination::Plan> plan;  ///< none: see `obstacle`
  coordination::OccupiedAreas areas;       ///< of the plan from t(k+1) on
  coordination::FallbackReason obstacle{coordination::FallbackReason::kNone};
  /// What was searched, that of the plan last: more than one where the first plan would have
  /// drifted into something, is held up or ends askew, where room is made, and after a switch.
  std::vector<SearchedProblem> problems;
};

/// Searches a new plan and checks it: the vehicle must be able to follow it, and its drift
/// (drift.hpp) must not lead into anything. If it does, a plan without drift is searched.
///
/// After a switch to another subgraph, the former one is searched when nothing is found on the new
/// one, until something is, for a horizon at most. A value (EngineCache).
class CandidateSearch {
 public:
  /// @throws std::invalid_argument as EngineCache
  CandidateSearch(PreparedSubgraph on, const search::SearchOptions& search,
                  std::size_t horizon_steps);

  /// The current subgraph.
  [[nodiscard]] const PreparedSubgraph& on() const { return current_.on(); }
  /// Only the current subgraph may be searched.
  [[nodiscard]] bool is_settled() const { return !former_; }
  /// Reachable sets of all subgraphs that may be searched, that of `on` first.
  [[nodiscard]] std::vector<const automaton::ReachableSets*> reachable() const;
  /// How far the vehicle can get from the trim within a horizon.
  [[nodiscard]] double reach_m(TrimId trim) const;

  /// @param now  the last step
  /// @pre as Controller::switch_to
  void switch_to(const PreparedSubgraph& next, const search::SearchOptions& search, StepIndex now);
  void set_max_expansions(std::size_t max_expansions);

  /// One search, unchecked, on the current subgraph.
  /// @param budget_share  CandidateInputs
  [[nodiscard]] search::SearchResult search(const search::HorizonProblem& problem,
                                            std::size_t budget_share = 1);
  /// Searches for a fraction of a millisecond and drops the result.
  /// @return expansions
  std::uint64_t warm_up(const search::HorizonProblem& problem);

  /// @param report  receives the figures of the search
  [[nodiscard]] PlanCandidate find(search::HorizonProblem problem, const CandidateInputs& inputs,
                                   coordination::Report& report);

 private:
  /// The subgraph before a switch.
  struct Former {
    EngineCache engine;
    StepIndex last;  ///< last step that may still use it
  };

  static void search_on(EngineCache& on, const CandidateInputs& inputs, PlanCandidate& candidate,
                        coordination::Report& report);
  static void search_with_and_without_drift(EngineCache& on, const CandidateInputs& inputs,
                                            PlanCandidate& candidate, coordination::Report& report);
  void search_on_former(const CandidateInputs& inputs, PlanCandidate& candidate,
                        coordination::Report& report);

  std::size_t horizon_steps_;
  EngineCache current_;
  std::optional<Former> former_;  ///< until something was found on `current_`
};

}  // namespace hlc::controller
