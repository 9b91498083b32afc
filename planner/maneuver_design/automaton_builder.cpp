#include "planner/maneuver_design/automaton_builder.hpp"

#include <set>
#include <stdexcept>

#include "planner/automaton/swept_area.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/maneuver_solver.hpp"

namespace hlc {
namespace {

void complete(Maneuver& maneuver, const AutomatonConfiguration& configuration) {
  maneuver.displacement = maneuver.states.back().pose;
  SweptAreas areas = swept_areas(maneuver, configuration.vehicle, configuration.identified);
  maneuver.swept_area_m = std::move(areas.swept_area_m);
  maneuver.lane_area_m = std::move(areas.lane_area_m);
}

Maneuver own_step(TrimId id, const AutomatonConfiguration& configuration) {
  const Trim& trim = configuration.trims[id.index];
  Maneuver step{id, id, kOwnStepLabel, configuration.step_s, {}, {}, {}, {}, {}};
  step.inputs.assign(configuration.intervals, Input{});
  for (std::size_t k = 0; k <= configuration.intervals; ++k) {
    const double time_s = configuration.step_s * static_cast<double>(k) /
                          static_cast<double>(configuration.intervals);
    const Pose pose =
        trim_motion(Pose{}, trim.speed_mps, trim.steering_rad, time_s, configuration.vehicle);
    step.states.push_back({pose, trim.speed_mps, trim.steering_rad});
  }
  complete(step, configuration);
  return step;
}

Maneuver designed(const TrimPair& edge, const std::string& criterion, const RunningCost& cost,
                  const AutomatonConfiguration& configuration) {
  const ManeuverProblem problem{configuration.trims[edge.from.index],
                                configuration.trims[edge.to.index],
                                configuration.step_s,
                                configuration.intervals,
                                configuration.vehicle,
                                configuration.limits};
  ManeuverSolution solution = solve(problem, cost);
  if (solution.status != ManeuverStatus::kOptimal) {
    throw std::invalid_argument(
        configuration.source + ": maneuver " + std::to_string(edge.from.index + 1) + " -> " +
        std::to_string(edge.to.index + 1) + " (" + criterion + "): " + solution.reason);
  }
  Maneuver maneuver{edge.from,
                    edge.to,
                    criterion,
                    configuration.step_s,
                    std::move(solution.inputs),
                    std::move(solution.states),
                    {},
                    {},
                    {}};
  complete(maneuver, configuration);
  return maneuver;
}

}  // namespace

UniversalAutomaton build_automaton(const AutomatonConfiguration& configuration) {
  UniversalAutomaton automaton;
  automaton.vehicle = configuration.vehicle;
  automaton.limits = configuration.limits;
  automaton.identified = configuration.identified;
  automaton.step_s = configuration.step_s;
  automaton.trims = configuration.trims;
  for (std::size_t i = 0; i < configuration.trims.size(); ++i) {
    automaton.maneuvers.push_back(own_step(TrimId{i}, configuration));
  }

  std::set<TrimPair> edges;
  for (const SubgraphSpec& subgraph : configuration.subgraphs) {
    for (const TrimPair& edge : chain_edges(configuration.trims, subgraph.trims)) {
      if (edge.from != edge.to) {
        edges.insert(edge);
      }
    }
  }
  for (const std::string& criterion : configuration.criteria) {
    const std::unique_ptr<RunningCost> cost = make_criterion(criterion, configuration.vehicle);
    for (const TrimPair& edge : edges) {
      automaton.maneuvers.push_back(designed(edge, criterion, *cost, configuration));
    }
  }
  return automaton;
}

std::shared_ptr<const UniversalAutomaton> build_shared_automaton(
    const AutomatonConfiguration& configuration) {
  return std::make_shared<const UniversalAutomaton>(build_automaton(configuration));
}

}  // namespace hlc
