#include "planner/maneuver_design/automaton_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "planner/automaton/maneuver_check.hpp"
#include "planner/automaton/swept_area.hpp"
#include "planner/automaton/trim_format.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/curvature_limit.hpp"
#include "planner/maneuver_design/friction_circle.hpp"
#include "planner/maneuver_design/unit_cost.hpp"
#include "planner/maneuver_design/weighted_sum.hpp"

namespace hlc::maneuver_design {
namespace {

/// A criterion whose range over the optima of others is smaller than this, relative, does not
/// contradict them.
constexpr double kNoSpread = 1e-6;

void complete(automaton::Maneuver& maneuver, const AutomatonConfiguration& configuration) {
  maneuver.displacement = maneuver.states.back().pose;
  automaton::SweptAreas areas =
      automaton::swept_areas(maneuver, configuration.vehicle, configuration.identified);
  maneuver.swept_area_m = std::move(areas.swept_area_m);
  maneuver.lane_area_m = std::move(areas.lane_area_m);
}

automaton::Maneuver self_loop(TrimId id, const AutomatonConfiguration& configuration) {
  const automaton::Trim& trim = configuration.trims[id.index];
  automaton::Maneuver step;
  step.from = id;
  step.to = id;
  step.label = automaton::kSelfLoopLabel;
  step.duration_s = configuration.step_s;
  step.inputs.assign(configuration.intervals, vehicle::Input{});
  for (std::size_t k = 0; k <= configuration.intervals; ++k) {
    const double time_s = configuration.step_s * static_cast<double>(k) /
                          static_cast<double>(configuration.intervals);
    const Pose pose = vehicle::trim_motion(Pose{}, trim.speed_mps, trim.steering_rad, time_s,
                                           configuration.vehicle);
    step.states.push_back({pose, trim.speed_mps, trim.steering_rad});
  }
  for (const std::string& name : criterion_names()) {
    const auto criterion = make_criterion(name, configuration.vehicle);
    step.criteria.push_back(
        {name, trim_step_cost(trim, configuration.step_s, *criterion, configuration.vehicle)});
  }
  complete(step, configuration);
  return step;
}

std::vector<CriterionValue> unit_costs(const automaton::Trim& trim,
                                       const AutomatonConfiguration& configuration) {
  std::vector<CriterionValue> costs;
  for (const std::string& name : criterion_names()) {
    const auto cost = unit_cost(trim, *make_criterion(name, configuration.vehicle));
    if (cost) costs.push_back({name, *cost});
  }
  return costs;
}

/// The place of the trims of the first subgraph with this edge; empty if none has it.
std::string place_of(const TrimPair& edge, const AutomatonConfiguration& c) {
  for (std::size_t i = 0; i < c.places.subgraphs.size(); ++i) {
    const automaton::SubgraphSpec& subgraph = c.subgraphs[i];
    const std::vector<TrimPair> pairs = automaton::rule_edges(
        subgraph.rule, c.trims, subgraph.trims, c.vehicle, c.limits, c.step_s);
    if (std::ranges::binary_search(pairs, edge) && !automaton::labels_of(subgraph, edge).empty()) {
      return c.places.subgraphs[i].trims;
    }
  }
  return "";
}

/// Throws: the key at fault if the configuration was read from a file, the maneuver, and the
/// reason.
[[noreturn]] void fail(const DesignTask& task, const AutomatonConfiguration& configuration,
                       const std::string& key, const std::string& allowed,
                       const std::string& reason) {
  throw std::invalid_argument(
      fmt::format("{}maneuver {} ({}): {}",
                  key.empty() ? configuration.source + ": " : key + ", must be " + allowed + "; ",
                  task.edge, configuration.criteria[task.criterion].label, reason));
}

automaton::UniversalAutomaton without_maneuvers(const AutomatonConfiguration& configuration) {
  automaton::UniversalAutomaton automaton;
  automaton.vehicle = configuration.vehicle;
  automaton.limits = configuration.limits;
  automaton.identified = configuration.identified;
  automaton.step_s = configuration.step_s;
  automaton.trims = configuration.trims;
  return automaton;
}

/// Whether the maneuver is designed as the mirror image of its mirror image's problem. Of two
/// mirrored pairs of trims exactly one is.
bool leans_right(const ManeuverProblem& problem) {
  const double sum_rad = problem.from.steering_rad + problem.to.steering_rad;
  return sum_rad < 0.0 || (sum_rad == 0.0 && problem.from.steering_rad < 0.0);
}

ManeuverProblem mirrored(ManeuverProblem problem) {
  problem.from.steering_rad = 0.0 - problem.from.steering_rad;
  problem.to.steering_rad = 0.0 - problem.to.steering_rad;
  return problem;
}

/// Mirrored along the direction of travel. (0 - x, since -0 is printed unlike 0.)
template <class Motion>
void mirror_motion(Motion& motion) {
  for (vehicle::Input& input : motion.inputs) {
    input.steering_rate_radps = 0.0 - input.steering_rate_radps;
  }
  for (vehicle::State& state : motion.states) {
    state.pose.y_m = 0.0 - state.pose.y_m;
    state.pose.heading_rad = 0.0 - state.pose.heading_rad;
    state.steering_rad = 0.0 - state.steering_rad;
  }
}

ManeuverSolution mirrored(ManeuverSolution solution) {
  mirror_motion(solution);
  return solution;
}

/// The areas are not mirrored: the identified vehicle is asymmetric.
automaton::Maneuver mirrored(automaton::Maneuver maneuver, const TrimPair& edge,
                             const AutomatonConfiguration& configuration) {
  maneuver.from = edge.from;
  maneuver.to = edge.to;
  mirror_motion(maneuver);
  complete(maneuver, configuration);
  return maneuver;
}

/// For each trim the one that steers as much to the other side; itself if there is none.
std::vector<TrimId> mirror_trims(const std::vector<automaton::Trim>& trims) {
  std::vector<TrimId> images;
  for (std::size_t i = 0; i < trims.size(); ++i) {
    const automaton::Trim image{trims[i].speed_mps, 0.0 - trims[i].steering_rad};
    const auto found = std::ranges::find(trims, image);
    images.push_back({found == trims.end() ? i : static_cast<std::size_t>(found - trims.begin())});
  }
  return images;
}

/// No criterion, bound or limit distinguishes left from right, so mirrored pairs of trims have
/// mirrored optima. Where several are equally good, the design must not prefer a side: one of the
/// two is solved, the other is its image.
ManeuverSolution solved(const ManeuverProblem& problem, const RunningCost& cost,
                        const DesignTask& task, const AutomatonConfiguration& configuration) {
  ManeuverSolution solution =
      leans_right(problem) ? mirrored(solve(mirrored(problem), cost)) : solve(problem, cost);
  if (solution.status != ManeuverStatus::kOptimal) {
    fail(task, configuration, place_of(task.edge, configuration),
         "trims with a maneuver wherever the rule connects two", solution.reason);
  }
  return solution;
}

double value_of(const std::string& criterion, const ManeuverSolution& solution) {
  const auto found =
      std::find_if(solution.criteria.begin(), solution.criteria.end(),
                   [&criterion](const CriterionValue& value) { return value.name == criterion; });
  return found->value;
}

/// See `design`.
WeightedSum normalised(const std::vector<CriterionWeight>& weights, const ManeuverProblem& problem,
                       const DesignTask& task, const AutomatonConfiguration& configuration) {
  std::vector<WeightedCost> terms;
  std::vector<ManeuverSolution> optima;
  for (const CriterionWeight& one : weights) {
    terms.push_back({one.weight, make_criterion(one.criterion, configuration.vehicle)});
    optima.push_back(solved(problem, *terms.back().cost, task, configuration));
  }
  std::vector<WeightedCost> kept;
  std::vector<CriterionRange> ranges;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    CriterionRange range{value_of(weights[i].criterion, optima[i]), 0.0};
    range.worst = range.best;
    for (const ManeuverSolution& other : optima) {
      range.worst = std::max(range.worst, value_of(weights[i].criterion, other));
    }
    if (range.worst - range.best <= kNoSpread * std::abs(range.best)) continue;
    kept.push_back(terms[i]);
    ranges.push_back(range);
  }
  if (kept.empty()) return WeightedSum({terms.front()});
  return normalised_sum(std::move(kept), ranges);
}

std::unique_ptr<RunningCost> make_cost(const ManeuverProblem& problem, const DesignTask& task,
                                       const AutomatonConfiguration& configuration) {
  const LabelledCriterion& criterion = configuration.criteria[task.criterion];
  if (const auto& point = criterion.front_point) {
    return make_criterion(point->minimised, configuration.vehicle);
  }
  if (criterion.weights.empty()) return make_criterion(criterion.label, configuration.vehicle);
  std::vector<CriterionWeight> weights = criterion.weights;
  std::erase_if(weights, [](const CriterionWeight& one) { return one.weight == 0.0; });
  if (criterion.normalised) {
    return std::make_unique<WeightedSum>(normalised(weights, problem, task, configuration));
  }
  std::vector<WeightedCost> terms;
  for (const CriterionWeight& one : weights) {
    terms.push_back({one.weight, make_criterion(one.criterion, configuration.vehicle)});
  }
  return std::make_unique<WeightedSum>(std::move(terms));
}

/// Adds the bound of a point of a front, see FrontPoint. Criteria that do not contradict each other
/// on these trims need none.
void add_bound(const FrontPoint& point, const DesignTask& task,
               const AutomatonConfiguration& configuration, ManeuverProblem& problem) {
  const auto minimised = make_criterion(point.minimised, configuration.vehicle);
  const std::shared_ptr<const RunningCost> bounded =
      make_criterion(point.bounded, configuration.vehicle);
  const double best = solved(problem, *bounded, task, configuration).cost;
  const double worst = value_of(point.bounded, solved(problem, *minimised, task, configuration));
  if (worst - best <= kNoSpread * std::abs(best)) return;
  problem.cost_bounds.push_back({bounded, best + point.share * (worst - best)});
}

/// Whether a maneuver from a trim back to it is designed.
bool is_self_loop_designed(TrimId trim, const AutomatonConfiguration& configuration) {
  const bool stands = configuration.trims[trim.index].is_equilibrium();
  return configuration.self_loops == SelfLoops::kOptimisedAll ||
         (configuration.self_loops == SelfLoops::kOptimised && !stands);
}

/// Pairs of trims whose maneuvers are needed, sorted.
std::set<TrimPair> needed_pairs(const AutomatonConfiguration& configuration) {
  std::set<TrimPair> needed;
  const auto add = [&](automaton::EdgeRule rule, const std::vector<TrimId>& trims,
                       const automaton::SubgraphSpec* subgraph) {
    for (const TrimPair& pair :
         automaton::rule_edges(rule, configuration.trims, trims, configuration.vehicle,
                               configuration.limits, configuration.step_s)) {
      if (pair.from == pair.to && !is_self_loop_designed(pair.from, configuration)) continue;
      if (subgraph != nullptr && automaton::labels_of(*subgraph, pair).empty()) continue;
      needed.insert(pair);
    }
  };
  for (const automaton::SubgraphSpec& subgraph : configuration.subgraphs) {
    add(subgraph.rule, subgraph.trims, &subgraph);
  }
  if (configuration.edges == EdgeChoice::kAll) {
    std::vector<TrimId> all;
    for (std::size_t i = 0; i < configuration.trims.size(); ++i) all.push_back({i});
    add(automaton::EdgeRule::kReachable, all, nullptr);
  }
  return needed;
}

}  // namespace

std::vector<DesignTask> design_tasks(const AutomatonConfiguration& configuration) {
  const std::set<TrimPair> pairs = needed_pairs(configuration);
  std::vector<DesignTask> tasks;
  for (std::size_t criterion = 0; criterion < configuration.criteria.size(); ++criterion) {
    for (const TrimPair& pair : pairs) tasks.push_back({pair, criterion});
  }
  return tasks;
}

ManeuverProblem problem_between(const automaton::Trim& from, const automaton::Trim& to,
                                const AutomatonConfiguration& configuration) {
  ManeuverProblem problem;
  problem.from = from;
  problem.to = to;
  problem.duration_s = configuration.step_s;
  problem.intervals = configuration.intervals;
  problem.vehicle = configuration.vehicle;
  problem.limits = configuration.limits;
  if (const auto friction_mps2 = configuration.limits.friction_mps2) {
    problem.path_constraints.push_back(
        std::make_shared<FrictionCircle>(*friction_mps2, configuration.vehicle));
  }
  if (const auto curvature_per_m = configuration.limits.curvature_max_per_m) {
    for (const auto side : {CurvatureLimit::Side::kLeft, CurvatureLimit::Side::kRight}) {
      problem.path_constraints.push_back(
          std::make_shared<CurvatureLimit>(side, *curvature_per_m, configuration.vehicle));
    }
  }
  return problem;
}

automaton::Maneuver design(const AutomatonConfiguration& configuration, const DesignTask& task) {
  ManeuverProblem problem = problem_between(configuration.trims[task.edge.from.index],
                                            configuration.trims[task.edge.to.index], configuration);
  if (const auto& point = configuration.criteria[task.criterion].front_point) {
    add_bound(*point, task, configuration, problem);
  }
  ManeuverSolution solution =
      solved(problem, *make_cost(problem, task, configuration), task, configuration);
  automaton::Maneuver maneuver;
  maneuver.from = task.edge.from;
  maneuver.to = task.edge.to;
  maneuver.label = configuration.criteria[task.criterion].label;
  maneuver.duration_s = configuration.step_s;
  maneuver.inputs = std::move(solution.inputs);
  maneuver.states = std::move(solution.states);
  maneuver.criteria = std::move(solution.criteria);
  complete(maneuver, configuration);
  if (const std::string fault = automaton::validate(maneuver, without_maneuvers(configuration));
      !fault.empty()) {
    fail(task, configuration, configuration.places.intervals, "more",
         fmt::format("{} with {} intervals", fault, configuration.intervals));
  }
  return maneuver;
}

std::vector<automaton::Maneuver> design(const AutomatonConfiguration& configuration,
                                        const std::vector<DesignTask>& tasks,
                                        const std::function<void()>& before_each) {
  const std::vector<TrimId> mirror = mirror_trims(configuration.trims);
  std::vector<automaton::Maneuver> designed;
  std::map<std::pair<TrimPair, std::size_t>, std::size_t> places;  // of edge and criterion
  for (const DesignTask& task : tasks) {
    if (before_each) before_each();
    const TrimPair& edge = task.edge;
    const auto image =
        places.find({{mirror[edge.from.index], mirror[edge.to.index]}, task.criterion});
    places[{edge, task.criterion}] = designed.size();
    designed.push_back(image == places.end()
                           ? design(configuration, task)
                           : mirrored(designed[image->second], edge, configuration));
  }
  return designed;
}

automaton::UniversalAutomaton assembled(const AutomatonConfiguration& configuration,
                                        std::vector<automaton::Maneuver> designed) {
  automaton::UniversalAutomaton automaton = without_maneuvers(configuration);
  for (std::size_t i = 0; i < configuration.trims.size(); ++i) {
    automaton.unit_costs.push_back(unit_costs(configuration.trims[i], configuration));
    automaton.maneuvers.push_back(self_loop(TrimId{i}, configuration));
  }
  for (automaton::Maneuver& maneuver : designed) automaton.maneuvers.push_back(std::move(maneuver));
  return automaton;
}

automaton::UniversalAutomaton build_automaton(const AutomatonConfiguration& configuration) {
  return assembled(configuration, design(configuration, design_tasks(configuration)));
}

std::shared_ptr<const automaton::UniversalAutomaton> build_shared_automaton(
    const AutomatonConfiguration& configuration) {
  return std::make_shared<const automaton::UniversalAutomaton>(build_automaton(configuration));
}

}  // namespace hlc::maneuver_design
