#include "tests/benchmarks/problem_sets.hpp"

#include <algorithm>
#include <stdexcept>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "tests/benchmarks/plain_search.hpp"
#include "tests/benchmarks/random_traffic.hpp"
#include "tests/benchmarks/three_cars.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

enum class Kind { kThreeCars, kThreeCarsCorridor, kThreeCarsIncumbent, kRandom, kBlocked, kNoPlan };

struct Recipe {
  ProblemSetInfo info;
  Kind kind{};
  std::size_t problems{};
  RandomTraffic traffic{};
  Automaton automaton{Automaton::kPaperB};
};

constexpr Others kAnywhere = Others::kDriveAnywhere;

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all{
      {{"three_cars", "three cars on their circuits, no lanes"}, Kind::kThreeCars, 150},
      {{"three_cars_corridor", "the same within lanes"}, Kind::kThreeCarsCorridor, 150},
      {{"three_cars_incumbent", "the same within lanes, with the plan in force as incumbent"},
       Kind::kThreeCarsIncumbent,
       150},
      {{"random_starts", "2 other cars"}, Kind::kRandom, 500, {8, 2, 1.5}},
      {{"cars_5", "5 other cars"}, Kind::kRandom, 300, {8, 5, 1.5}},
      {{"cars_10", "10 other cars"}, Kind::kRandom, 300, {8, 10, 1.9}},
      {{"cars_19", "19 other cars"}, Kind::kRandom, 300, {8, 19, 2.3}},
      {{"horizon_8", "8 steps, 3 other cars"}, Kind::kRandom, 200, {8, 3, 1.5}},
      {{"horizon_12", "12 steps, 3 other cars"}, Kind::kRandom, 200, {12, 3, 1.5}},
      {{"horizon_16", "16 steps, 3 other cars"}, Kind::kRandom, 200, {16, 3, 1.5}},
      {{"trims_12", "12 trims, 3 other cars"}, Kind::kRandom, 200, {8, 3, 1.5}},
      {{"trims_34", "34 trims, 3 other cars"}, Kind::kRandom, 100, {8, 3, 1.5}, Automaton::kGrid34},
      {{"trims_95", "95 trims, 3 other cars"}, Kind::kRandom, 100, {8, 3, 1.5}, Automaton::kGrid95},
      {{"maneuvers_j1", "maneuvers that outrun their trims, 2 other cars"},
       Kind::kRandom,
       200,
       {8, 2, 1.5, 1.2},
       Automaton::kPaperA},
      {{"infeasible", "every end blocked, from standstill"}, Kind::kBlocked, 10, {8, 0, 0.0}},
      {{"infeasible_random", "19 other cars leave no plan"},
       Kind::kNoPlan,
       50,
       {8, 19, 1.5, 0.8, kAnywhere}},
  };
  return all;
}

const Recipe& recipe(const std::string& name) {
  for (const Recipe& one : recipes()) {
    if (one.info.name == name) return one;
  }
  std::string allowed;
  for (const Recipe& one : recipes()) allowed += (allowed.empty() ? "" : ", ") + one.info.name;
  throw std::invalid_argument("problem set " + name + ", must be one of " + allowed);
}

std::shared_ptr<const automaton::Subgraph> built(
    const std::string& name, const maneuver_design::AutomatonConfiguration& configuration) {
  const automaton::SubgraphSpec& spec =
      *std::ranges::find(configuration.subgraphs, name, &automaton::SubgraphSpec::name);
  return std::make_shared<const automaton::Subgraph>(
      maneuver_design::build_shared_automaton(maneuver_design::needed_by(spec, configuration)),
      spec);
}

maneuver_design::AutomatonConfiguration shipped(const std::string& file) {
  return maneuver_design::read_automaton_configuration(test::source_folder() +
                                                       "/launch_scripts/automata/" + file);
}

/// 95 trims: standstill, and six speeds up to 0.8 m/s with fifteen steering angles, the two lowest
/// with seventeen. The limits allow one speed and one angle up or down in a step.
maneuver_design::AutomatonConfiguration grid_of_95() {
  constexpr double kBetweenSpeeds_mps = 0.8 / 6.0;
  constexpr double kBetweenAngles_rad = 0.06;
  maneuver_design::AutomatonConfiguration grid = shipped("ucar_grid_34.yaml");
  grid.trims = {automaton::Trim{}};
  for (int speed = 1; speed <= 6; ++speed) {
    const int angles = speed <= 2 ? 8 : 7;
    for (int angle = -angles; angle <= angles; ++angle) {
      grid.trims.push_back({kBetweenSpeeds_mps * speed, kBetweenAngles_rad * angle});
    }
  }
  grid.limits.acceleration_mps2 = 1.01 * kBetweenSpeeds_mps / grid.step_s;
  grid.limits.steering_rate_radps = 1.01 * kBetweenAngles_rad / grid.step_s;
  for (automaton::SubgraphSpec& spec : grid.subgraphs) {
    spec.trims.clear();
    for (std::size_t i = 0; i < grid.trims.size(); ++i) spec.trims.push_back(TrimId{i});
  }
  return grid;
}

std::shared_ptr<const automaton::Subgraph> built_subgraph(Automaton automaton) {
  switch (automaton) {
    case Automaton::kPaperB:
      return built("B", shipped("paper.yaml"));
    case Automaton::kPaperA:
      return built("A", shipped("paper.yaml"));
    case Automaton::kGrid34:
      return built("J2", shipped("ucar_grid_34.yaml"));
    case Automaton::kGrid95:
      return built("J2", grid_of_95());
  }
  return nullptr;
}

std::vector<search::HorizonProblem> three_cars(
    const std::shared_ptr<const automaton::Subgraph>& subgraph, Kind kind, std::size_t steps) {
  const Lanes lanes = kind == Kind::kThreeCars ? Lanes::kNone : Lanes::kCorridor;
  std::vector<search::HorizonProblem> problems = three_cars_problems(subgraph, lanes, steps);
  if (kind == Kind::kThreeCarsIncumbent) return problems;
  for (search::HorizonProblem& problem : problems) problem.incumbent.clear();
  return problems;
}

/// Of the problems with seeds 0, 1, ... the first without a plan.
std::vector<search::HorizonProblem> problems_without_plan(
    const automaton::Subgraph& subgraph, std::span<const road::ReferencePath> routes,
    const RandomTraffic& traffic, std::size_t count) {
  const PlainSearch search(subgraph);
  std::vector<search::HorizonProblem> problems;
  for (std::uint64_t seed = 0; problems.size() < count; ++seed) {
    search::HorizonProblem problem = random_traffic_problem(subgraph, routes, traffic, seed);
    if (!search.search(problem).feasible) problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace

std::span<const ProblemSetInfo> problem_set_infos() {
  static const std::vector<ProblemSetInfo> infos = [] {
    std::vector<ProblemSetInfo> result;
    for (const Recipe& one : recipes()) result.push_back(one.info);
    return result;
  }();
  return infos;
}

ProblemSets::ProblemSets() : routes_(three_cars_routes()) {}

std::shared_ptr<const automaton::Subgraph> ProblemSets::subgraph(Automaton automaton) {
  std::shared_ptr<const automaton::Subgraph>& known = subgraphs_[automaton];
  if (!known) known = built_subgraph(automaton);
  return known;
}

ProblemSet ProblemSets::make(const std::string& name, std::size_t max_problems) {
  const Recipe& from = recipe(name);
  const std::size_t count =
      max_problems == 0 ? from.problems : std::min(max_problems, from.problems);
  ProblemSet set{.name = name,
                 .subgraph = subgraph(from.automaton),
                 .horizon_steps = from.traffic.horizon_steps};
  switch (from.kind) {
    case Kind::kThreeCars:
    case Kind::kThreeCarsCorridor:
    case Kind::kThreeCarsIncumbent:
      set.problems = three_cars(set.subgraph, from.kind, count);
      break;
    case Kind::kRandom:
      for (std::uint64_t seed = 0; seed < count; ++seed) {
        set.problems.push_back(random_traffic_problem(*set.subgraph, routes_, from.traffic, seed));
      }
      break;
    case Kind::kBlocked:
      for (std::uint64_t seed = 0; seed < count; ++seed) {
        set.problems.push_back(
            blocked_end_problem(*set.subgraph, routes_, from.traffic.horizon_steps, seed));
      }
      break;
    case Kind::kNoPlan:
      set.problems = problems_without_plan(*set.subgraph, routes_, from.traffic, count);
      break;
  }
  return set;
}

}  // namespace hlc::test
