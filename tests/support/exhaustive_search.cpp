#include "tests/support/exhaustive_search.hpp"

#include <algorithm>

#include "tests/support/plan_check.hpp"

namespace hlc::test {
namespace {

class Enumeration {
 public:
  Enumeration(const automaton::Subgraph& subgraph, const search::HorizonProblem& problem,
              const std::vector<search::PlanningWeight>& weights)
      : subgraph_(subgraph), problem_(problem), weights_(weights) {}

  ExhaustiveResult run() {
    try_all(problem_.start, problem_.start_trim, 0.0);
    return best_;
  }

 private:
  void try_all(const Pose& pose, TrimId trim, double cost) {
    const std::size_t done = path_.size();
    if (done == problem_.horizon_steps()) {
      finish(trim, cost);
      return;
    }
    for (const automaton::Edge& edge : subgraph_.successors(trim)) {
      if (!is_allowed(edge) || !is_free(*edge.maneuver, pose, done + 1, problem_)) {
        continue;
      }
      const Pose next = compose(pose, edge.maneuver->displacement);
      const double step_cost = position_cost_m2(problem_, done + 1, next.position_m()) +
                               weighted_criteria(*edge.maneuver, weights_);
      path_.push_back(edge.maneuver);
      try_all(next, edge.to, cost + step_cost);
      path_.pop_back();
    }
  }

  [[nodiscard]] bool is_allowed(const automaton::Edge& edge) const {
    const automaton::UniversalAutomaton& automaton = subgraph_.automaton();
    const TrimId from = edge.maneuver->from;
    const bool stands = automaton.trims[from.index].speed_mps == 0.0 &&
                        automaton.trims[edge.to.index].speed_mps == 0.0;
    const bool is_first = path_.empty() && problem_.may_turn_in_place;
    if (stands && from != edge.to && !is_first) return false;
    return !problem_.avoids_steering_limit ||
           !automaton::is_at_steering_limit(automaton.trims[edge.to.index], automaton.vehicle,
                                            automaton.identified);
  }

  void finish(TrimId trim, double cost) {
    if (subgraph_.automaton().trims[trim.index].speed_mps != 0.0) {
      return;
    }
    ++best_.complete_paths;
    if (!path_.empty()) {
      double& least = best_.cost_by_first.try_emplace(path_.front(), cost).first->second;
      least = std::min(least, cost);
    }
    if (!best_.feasible || cost < best_.cost) {
      best_.feasible = true;
      best_.cost = cost;
      best_.maneuvers = path_;
    }
  }

  const automaton::Subgraph& subgraph_;
  const search::HorizonProblem& problem_;
  const std::vector<search::PlanningWeight>& weights_;
  std::vector<const automaton::Maneuver*> path_;
  ExhaustiveResult best_;
};

}  // namespace

ExhaustiveResult exhaustive_search(const automaton::Subgraph& subgraph,
                                   const search::HorizonProblem& problem,
                                   const std::vector<search::PlanningWeight>& weights) {
  return Enumeration(subgraph, problem, weights).run();
}

}  // namespace hlc::test
