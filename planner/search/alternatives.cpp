#include "planner/search/alternatives.hpp"

#include <algorithm>
#include <memory>

#include "planner/common/demand.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::search {
namespace {

template <class Value>
void drop_first(std::vector<Value>& values) {
  if (!values.empty()) values.erase(values.begin());
}

/// What remains to be planned behind the first maneuver.
HorizonProblem behind(const automaton::Maneuver& first, const HorizonProblem& problem) {
  HorizonProblem rest = problem;
  rest.start = compose(problem.start, first.displacement);
  rest.start_trim = first.to;
  drop_first(rest.reference_m);
  drop_first(rest.contouring);
  drop_first(rest.reference_speed_mps);
  drop_first(rest.obstacles_m);
  drop_first(rest.avoided_in_motion_m);
  rest.incumbent.clear();
  rest.may_turn_in_place = false;
  return rest;
}

/// Puts the first maneuver, of that cost, before a result of the problem behind it.
void put_before(const automaton::Maneuver& first, const Pose& to, double cost_m2,
                SearchResult& result) {
  if (result.status == SearchStatus::kFallback) return;
  result.cost += cost_m2;
  result.lower_bound += cost_m2;
  result.maneuvers.insert(result.maneuvers.begin(), &first);
  result.poses.insert(result.poses.begin(), to);
}

}  // namespace

std::vector<Alternative> alternatives_to(const automaton::Maneuver* except,
                                         const automaton::Subgraph& subgraph,
                                         const automaton::ReachableSets& reachable,
                                         const SearchOptions& options,
                                         const HorizonProblem& problem,
                                         std::shared_ptr<const SearchTables> tables) {
  HLC_DEMAND(problem.horizon_steps() >= 1 && is_admissible(options.cost_to_go));
  const automaton::UniversalAutomaton& automaton = subgraph.automaton();
  const EdgeCosts costs(subgraph, options.criterion_weights, problem.horizon_steps());
  const std::unique_ptr<SearchEngine> engine =
      make_search_engine(subgraph, reachable, options, std::move(tables));
  std::vector<Alternative> alternatives;
  for (const automaton::Edge& edge :
       subgraph.successors(problem.start_trim, problem.horizon_steps())) {
    const bool ends_at_limit = automaton::is_at_steering_limit(
        automaton.trims[edge.to.index], automaton.vehicle, automaton.identified);
    if (edge.maneuver == except || (ends_at_limit && problem.avoids_steering_limit)) continue;
    if (turns_in_place(*edge.maneuver) && !problem.may_turn_in_place) continue;
    Alternative alternative{.first = edge.maneuver, .obstruction = {}, .best = {}};
    alternative.obstruction = obstruction_of(*edge.maneuver, 1, to_frame(problem.start), problem);
    if (!alternative.obstruction) {
      const HorizonProblem rest = behind(*edge.maneuver, problem);
      const double cost_m2 = problem.position_cost_m2(0, rest.start.position_m()) +
                             costs.reduced_cost(*edge.maneuver) + costs.least();
      alternative.best = engine->search(rest);
      put_before(*edge.maneuver, rest.start, cost_m2, alternative.best);
    }
    alternatives.push_back(std::move(alternative));
  }
  return alternatives;
}

const Alternative* runner_up(const std::vector<Alternative>& alternatives) {
  const Alternative* best = nullptr;
  for (const Alternative& one : alternatives) {
    if (one.best.status == SearchStatus::kFallback) continue;
    if (best == nullptr || one.best.cost < best->best.cost) best = &one;
  }
  return best;
}

}  // namespace hlc::search
