#include "tests/benchmarks/problem_sets.hpp"

#include <algorithm>
#include <stdexcept>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "tests/benchmarks/plain_search.hpp"
#include "tests/benchmarks/random_traffic.hpp"
#include "tests/benchmarks/three_cars.hpp"

namespace hlc::test {
namespace {

enum class Kind { kThreeCars, kThreeCarsCorridor, kThreeCarsIncumbent, kRandom, kBlocked, kNoPlan };

struct Recipe {
  ProblemSetInfo info;
  Kind kind{};
  std::size_t problems{};
  RandomTraffic traffic{};
  const char* automaton{"paper.yaml"};
  const char* subgraph{"B"};
  std::size_t leave_out{};
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
      {{"trims_34", "34 trims, 3 other cars"},
       Kind::kRandom,
       200,
       {8, 3, 1.5},
       "ucar_grid_34.yaml",
       "J2"},
      {{"trims_95", "95 trims, 3 other cars"},
       Kind::kRandom,
       100,
       {8, 3, 1.5},
       "ucar_grid_96.yaml",
       "J2",
       1},
      {{"maneuvers_j1", "maneuvers that outrun their trims, 2 other cars"},
       Kind::kRandom,
       200,
       {8, 2, 1.5},
       "paper.yaml",
       "A"},
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
  throw std::invalid_argument("problem set " + name + ", allowed " + allowed);
}

std::vector<HorizonProblem> three_cars(const std::shared_ptr<const Subgraph>& subgraph, Kind kind,
                                       std::size_t steps) {
  const Lanes lanes = kind == Kind::kThreeCars ? Lanes::kNone : Lanes::kCorridor;
  std::vector<HorizonProblem> problems = three_cars_problems(subgraph, lanes, steps);
  if (kind == Kind::kThreeCarsIncumbent) return problems;
  for (HorizonProblem& problem : problems) problem.incumbent.clear();
  return problems;
}

/// Of the problems with seeds 0, 1, ... the first without a plan.
std::vector<HorizonProblem> problems_without_plan(const Subgraph& subgraph,
                                                  const RandomTraffic& traffic, std::size_t count) {
  const PlainSearch search(subgraph);
  std::vector<HorizonProblem> problems;
  for (std::uint64_t seed = 0; problems.size() < count; ++seed) {
    HorizonProblem problem = random_traffic_problem(subgraph, traffic, seed);
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

std::shared_ptr<const Subgraph> ProblemSets::subgraph(const std::string& file,
                                                      const std::string& name,
                                                      std::size_t leave_out) {
  std::shared_ptr<const Subgraph>& known = subgraphs_[{file, name}];
  if (known) return known;
  const AutomatonConfiguration configuration =
      read_automaton_configuration(HLC_SOURCE_DIR "/launch_scripts/automata/" + file);
  SubgraphSpec spec = *std::ranges::find(configuration.subgraphs, name, &SubgraphSpec::name);
  spec.trims.resize(spec.trims.size() - leave_out);
  known = std::make_shared<const Subgraph>(build_shared_automaton(needed_by(spec, configuration)),
                                           spec);
  return known;
}

ProblemSet ProblemSets::make(const std::string& name, std::size_t max_problems) {
  const Recipe& from = recipe(name);
  const std::size_t count =
      max_problems == 0 ? from.problems : std::min(max_problems, from.problems);
  ProblemSet set{.name = name,
                 .subgraph = subgraph(from.automaton, from.subgraph, from.leave_out),
                 .horizon_steps = from.traffic.horizon_steps};
  switch (from.kind) {
    case Kind::kThreeCars:
    case Kind::kThreeCarsCorridor:
    case Kind::kThreeCarsIncumbent:
      set.problems = three_cars(set.subgraph, from.kind, count);
      break;
    case Kind::kRandom:
      for (std::uint64_t seed = 0; seed < count; ++seed) {
        set.problems.push_back(random_traffic_problem(*set.subgraph, from.traffic, seed));
      }
      break;
    case Kind::kBlocked:
      for (std::uint64_t seed = 0; seed < count; ++seed) {
        set.problems.push_back(
            blocked_end_problem(*set.subgraph, from.traffic.horizon_steps, seed));
      }
      break;
    case Kind::kNoPlan:
      set.problems = problems_without_plan(*set.subgraph, from.traffic, count);
      break;
  }
  return set;
}

}  // namespace hlc::test
