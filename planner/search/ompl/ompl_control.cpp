#include "planner/search/ompl/ompl_control.hpp"

#include <ompl/control/StatePropagator.h>
#include <ompl/control/spaces/DiscreteControlSpace.h>

#include <algorithm>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/common/demand.hpp"
#include "planner/search/collision.hpp"

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace hlc::search {
namespace {

using ControlType = oc::DiscreteControlSpace::ControlType;

/// Adds a footprint of room to the reachable box.
constexpr double kRoom_m = 0.1;

class ManeuverPropagator final : public oc::StatePropagator {
 public:
  ManeuverPropagator(const oc::SpaceInformationPtr& si, const automaton::Subgraph& subgraph,
                     const automaton::ReachableSets& reachable, const HorizonProblem& problem)
      : StatePropagator(si),
        subgraph_(subgraph),
        problem_(problem),
        collision_(subgraph, reachable) {
    collision_.prepare(problem);
  }

  void propagate(const ob::State* state, const oc::Control* control, double /*duration*/,
                 ob::State* result) const override {
    const HorizonState from = read_state(*state);
    const automaton::Maneuver* maneuver = edge(from, control->as<ControlType>()->value);
    if (maneuver == nullptr || !collision_.is_free(*maneuver, from.step + 1, to_frame(from.pose))) {
      HorizonState nowhere = from;
      nowhere.step = problem_.horizon_steps() + 1;  // out of bounds
      write_state(nowhere, *result);
      return;
    }
    write_state({compose(from.pose, maneuver->displacement), maneuver->to, from.step + 1}, *result);
  }
  bool canPropagateBackward() const override { return false; }

  /// The control's number of a maneuver in that state.
  [[nodiscard]] int number_of(const HorizonState& from, const automaton::Maneuver& maneuver) const {
    const std::vector<const automaton::Maneuver*> choices = edges(from);
    const auto found = std::ranges::find(choices, &maneuver);
    HLC_DEMAND(found != choices.end(), from.step);
    return static_cast<int>(found - choices.begin());
  }

 private:
  [[nodiscard]] std::vector<const automaton::Maneuver*> edges(const HorizonState& from) const {
    std::vector<const automaton::Maneuver*> choices;
    const automaton::UniversalAutomaton& automaton = subgraph_.automaton();
    if (from.step >= problem_.horizon_steps()) return choices;
    for (const automaton::Edge& one :
         subgraph_.successors(from.trim, problem_.horizon_steps() - from.step)) {
      if (problem_.avoids_steering_limit &&
          automaton::is_at_steering_limit(automaton.trims[one.to.index], automaton.vehicle,
                                          automaton.identified)) {
        continue;
      }
      if (turns_in_place(*one.maneuver) && (from.step > 0 || !problem_.may_turn_in_place)) continue;
      choices.push_back(one.maneuver);
    }
    return choices;
  }
  [[nodiscard]] const automaton::Maneuver* edge(const HorizonState& from, int number) const {
    const std::vector<const automaton::Maneuver*> choices = edges(from);
    if (choices.empty()) return nullptr;
    return choices[static_cast<std::size_t>(number) % choices.size()];
  }

  const automaton::Subgraph& subgraph_;
  const HorizonProblem& problem_;
  mutable CollisionCheck collision_;  // its buffers only
};

PositionBounds reach_of(const automaton::ReachableSets& reachable, const HorizonProblem& problem) {
  double reach_m = kRoom_m;
  for (std::size_t i = 1; i <= problem.horizon_steps(); ++i) {
    reach_m = std::max(reach_m, kRoom_m + reachable.max_distance_m(problem.start_trim, i,
                                                                   problem.horizon_steps() - i));
  }
  const Point start_m = problem.start.position_m();
  return {start_m - Point::Constant(reach_m), start_m + Point::Constant(reach_m)};
}

int max_edges(const automaton::Subgraph& subgraph) {
  std::size_t most = 1;
  for (const TrimId trim : subgraph.start_trims()) {
    most = std::max(most, subgraph.successors(trim).size());
  }
  return static_cast<int>(most);
}

}  // namespace

std::shared_ptr<oc::SpaceInformation> make_control_space_information(
    const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
    const HorizonProblem& problem) {
  const ob::StateSpacePtr states =
      make_state_space(subgraph, problem.horizon_steps(), reach_of(reachable, problem));
  const auto controls =
      std::make_shared<oc::DiscreteControlSpace>(states, 0, max_edges(subgraph) - 1);
  auto si = std::make_shared<oc::SpaceInformation>(states, controls);
  si->setStatePropagator(std::make_shared<ManeuverPropagator>(si, subgraph, reachable, problem));
  const oc::SpaceInformation* space = si.get();
  si->setStateValidityChecker(
      [space](const ob::State* state) { return space->satisfiesBounds(state); });
  si->setPropagationStepSize(subgraph.automaton().step_s);
  si->setMinMaxControlDuration(1, 1);
  si->setup();
  return si;
}

ob::PathPtr make_control_path(const std::shared_ptr<oc::SpaceInformation>& si,
                              const HorizonProblem& problem, const SearchResult& plan) {
  const auto* propagator = dynamic_cast<const ManeuverPropagator*>(si->getStatePropagator().get());
  HLC_DEMAND(propagator != nullptr);
  auto path = std::make_shared<oc::PathControl>(si);
  ob::State* state = si->allocState();
  oc::Control* control = si->allocControl();
  HorizonState at{problem.start, problem.start_trim, 0};
  write_state(at, *state);
  path->append(state);
  for (std::size_t j = 0; j < plan.maneuvers.size(); ++j) {
    control->as<ControlType>()->value = propagator->number_of(at, *plan.maneuvers[j]);
    at = {plan.poses[j], plan.maneuvers[j]->to, j + 1};
    write_state(at, *state);
    path->append(state, control, si->getPropagationStepSize());
  }
  si->freeControl(control);
  si->freeState(state);
  return path;
}

ob::Cost path_cost(const oc::PathControl& path, const ob::OptimizationObjective& objective) {
  ob::Cost sum = objective.identityCost();
  for (unsigned j = 1; j < path.getStateCount(); ++j) {
    sum = objective.combineCosts(sum, objective.motionCost(path.getState(j - 1), path.getState(j)));
  }
  return sum;
}

}  // namespace hlc::search
