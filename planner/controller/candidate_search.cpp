#include "planner/controller/candidate_search.hpp"

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/controller/trajectory.hpp"

namespace hlc::controller {
namespace {

/// Swept areas are rounded outwards before they enter the reachable area.
constexpr double kReachRounding_m = 1e-5;

/// A warm-up ends when the engine has checked for a stop this often, every 64 expansions: after a
/// fraction of a millisecond.
constexpr int kWarmUpLooks = 16;

coordination::PlanQuality quality_of(search::SearchStatus found) {
  switch (found) {
    case search::SearchStatus::kOptimal:
      return coordination::PlanQuality::kOptimal;
    case search::SearchStatus::kUnproven:
      return coordination::PlanQuality::kUnproven;
    case search::SearchStatus::kBudget:
      return coordination::PlanQuality::kBudget;
    case search::SearchStatus::kFallback:
      break;
  }
  return coordination::PlanQuality::kNone;
}

void add_figures(const search::SearchResult& result, const automaton::Subgraph& on,
                 coordination::Report& report) {
  report.generated += result.generated;
  report.expanded += result.expanded;
  if (result.status == search::SearchStatus::kFallback) return;
  report.subgraph = on.spec().name;
  report.cost_m2 = result.cost;
  report.quality = quality_of(result.status);
  report.gap_m2 =
      result.status == search::SearchStatus::kOptimal ? 0.0 : result.cost - result.lower_bound;
}

/// The command of the plan is checked before the plan is published.
bool is_drivable(const coordination::Plan& plan, const CandidateInputs& inputs,
                 const automaton::UniversalAutomaton& automaton) {
  if (!inputs.lab) return true;
  return !vehicle::trajectory_fault(
      sample_trajectory(plan, inputs.now, inputs.lab->point_interval_s, 0.0, automaton.step_s,
                        automaton.vehicle),
      inputs.lab);
}

/// The search has kept the swept areas free, and they are within reach; areas with drift may be
/// larger.
bool is_free(const PlanCandidate& candidate, const CandidateInputs& inputs) {
  const coordination::OccupiedAreas& areas = candidate.areas;
  const auto is_in_reach = [&](const ConvexPolygon& area) {
    return contains(inputs.reachable_area_m, area, kReachRounding_m);
  };
  if (inputs.in_force.may_drift(*candidate.plan) &&
      !(std::ranges::all_of(areas.areas_m, is_in_reach) && is_in_reach(areas.final_area_m))) {
    return false;
  }
  const search::HorizonProblem& problem = candidate.problems.back().problem;
  const auto meets_any = [&](const std::vector<std::vector<ConvexPolygon>>& obstacles_m,
                             std::size_t j) {
    if (obstacles_m.empty()) return false;
    const ConvexPolygon& area = areas.during({inputs.now.value + 1 + j});
    return std::ranges::any_of(obstacles_m[j], [&area](const ConvexPolygon& obstacle) {
      return intersects(area, obstacle);
    });
  };
  for (std::size_t j = 0; j < problem.horizon_steps(); ++j) {
    if (meets_any(problem.obstacles_m, j)) return false;
    const bool stands =
        search::stands_in(candidate.plan->maneuver_during({inputs.now.value + 1 + j}));
    if (!stands && meets_any(problem.avoided_in_motion_m, j)) return false;
  }
  return true;
}

}  // namespace

CandidateSearch::CandidateSearch(PreparedSubgraph on, const search::SearchOptions& search,
                                 std::size_t horizon_steps)
    : horizon_steps_(horizon_steps), current_(std::move(on), search) {}

std::vector<const automaton::ReachableSets*> CandidateSearch::reachable() const {
  std::vector<const automaton::ReachableSets*> result{current_.on().reachable.get()};
  if (former_) result.push_back(former_->engine.on().reachable.get());
  return result;
}

double CandidateSearch::reach_m(TrimId trim) const {
  const auto reach_in = [&](const PreparedSubgraph& on) {
    return on.reachable->max_distance_m(trim, horizon_steps_, 0);
  };
  return std::max(reach_in(current_.on()), former_ ? reach_in(former_->engine.on()) : 0.0);
}

void CandidateSearch::switch_to(const PreparedSubgraph& next, const search::SearchOptions& search,
                                StepIndex now) {
  HLC_DEMAND(next.subgraph->automaton().trims == on().subgraph->automaton().trims);
  HLC_DEMAND(next.reachable->max_steps() > horizon_steps_, next.reachable->max_steps(),
             horizon_steps_);
  EngineCache engine(next, search);
  // Of several switches in a row: the subgraph that the plan in force was found on.
  if (!former_) former_ = Former{std::move(current_), {}};
  former_->last = {now.value + horizon_steps_};
  current_ = std::move(engine);
}

void CandidateSearch::set_max_expansions(std::size_t max_expansions) {
  current_.set_max_expansions(max_expansions);
  if (former_) former_->engine.set_max_expansions(max_expansions);
}

search::SearchResult CandidateSearch::search(const search::HorizonProblem& problem,
                                             std::size_t budget_share) {
  return current_.search(problem, budget_share);
}

std::uint64_t CandidateSearch::warm_up(const search::HorizonProblem& problem) {
  int looks = 0;
  return current_.engine().search(problem, [&looks] { return ++looks > kWarmUpLooks; }).expanded;
}

PlanCandidate CandidateSearch::find(search::HorizonProblem problem, const CandidateInputs& inputs,
                                    coordination::Report& report) {
  PlanCandidate candidate;
  candidate.problems.push_back(
      {std::move(problem), on().subgraph, current_.max_expansions(inputs.budget_share)});
  search_with_and_without_drift(current_, inputs, candidate, report);
  if (former_) search_on_former(inputs, candidate, report);
  return candidate;
}

void CandidateSearch::search_on(EngineCache& on, const CandidateInputs& inputs,
                                PlanCandidate& candidate, coordination::Report& report) {
  const automaton::Subgraph& subgraph = *on.on().subgraph;
  const search::SearchResult result =
      on.search(candidate.problems.back().problem, inputs.budget_share);
  add_figures(result, subgraph, report);
  if (result.status == search::SearchStatus::kFallback) {
    candidate.obstacle = result.reason == search::NoPath::kBudget
                             ? coordination::FallbackReason::kBudget
                             : coordination::FallbackReason::kInfeasible;
    return;
  }
  const StepIndex next{inputs.now.value + 1};
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  candidate.plan = inputs.in_force.base().continued(
      next, result.maneuvers, self_loop(automaton, result.maneuvers.back()->to),
      subgraph.shared_automaton());
  candidate.areas = inputs.in_force.areas_of(*candidate.plan, next);
  if (!is_drivable(*candidate.plan, inputs, automaton)) {
    candidate.obstacle = coordination::FallbackReason::kUndrivable;
  } else if (!is_free(candidate, inputs)) {
    candidate.obstacle = coordination::FallbackReason::kConflict;
  }
  if (candidate.obstacle != coordination::FallbackReason::kNone) candidate.plan.reset();
}

void CandidateSearch::search_with_and_without_drift(EngineCache& on, const CandidateInputs& inputs,
                                                    PlanCandidate& candidate,
                                                    coordination::Report& report) {
  search_on(on, inputs, candidate, report);
  if (candidate.obstacle != coordination::FallbackReason::kConflict) return;
  SearchedProblem without_drift = candidate.problems.back();
  without_drift.problem.avoids_steering_limit = true;
  candidate.problems.push_back(std::move(without_drift));
  candidate.obstacle = coordination::FallbackReason::kNone;
  search_on(on, inputs, candidate, report);
}

void CandidateSearch::search_on_former(const CandidateInputs& inputs, PlanCandidate& candidate,
                                       coordination::Report& report) {
  if (candidate.plan || inputs.now > former_->last) {
    former_.reset();
    return;
  }
  // A second search would take as long again: the former subgraph is tried in the next step.
  if (candidate.obstacle == coordination::FallbackReason::kBudget) return;
  candidate.obstacle = coordination::FallbackReason::kNone;
  candidate.problems.push_back({candidate.problems.front().problem, former_->engine.on().subgraph,
                                former_->engine.max_expansions(inputs.budget_share)});
  search_with_and_without_drift(former_->engine, inputs, candidate, report);
}

}  // namespace hlc::controller
