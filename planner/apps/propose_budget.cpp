// Proposes a budget of expansions for a deadline, measured on this machine with the problems of a
// scenario. A run never measures: the budget stays a number in the scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"

namespace {

using Clock = std::chrono::steady_clock;

/// Searches of fewer expansions do not show the time of one: most of their time is the preparation
/// of the search, which they measure.
constexpr std::size_t kInformative = 1000;
constexpr int kCalls = 3;
/// The tree of a long horizon is practically infinite: measuring stops here.
constexpr std::size_t kMeasured = 300'000;

struct Flags {
  hlc::scenario::ScenarioChoices scenario;
  double deadline_ms{};
  double safety{2.0};
};

struct Measured {
  std::string what;
  std::size_t problems{};
  std::size_t expansions{};  ///< of the slowest one
  double time_s{};
  [[nodiscard]] double rate_per_s() const { return static_cast<double>(expansions) / time_s; }
};

void declare(CLI::App& app, Flags& flags) {
  hlc::apps::declare_scenario(app, "SCENARIO,--scenario", flags.scenario.file)->required();
  app.add_option("--deadline_ms", flags.deadline_ms, "that a plan may take")
      ->required()
      ->check(hlc::apps::within(0.001, 1e6));
  app.add_option("--safety", flags.safety,
                 "factor: the search is expected to need 1 / safety of the deadline")
      ->check(hlc::apps::within(1.0, 1000.0))
      ->capture_default_str();
  hlc::apps::declare_profile_flag(app, flags.scenario.profile);
  app.add_option("--engine", flags.scenario.engine, "search engine, instead of the scenario's");
  app.add_option("--subgraph", flags.scenario.subgraph, "instead of the scenario's");
  app.add_option("--steps", flags.scenario.steps, "that are looked at, instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  hlc::apps::declare_help_end(
      app, {.examples = {"propose_budget --scenario paper_three_cars --deadline_ms 100",
                         "propose_budget lab_cars --deadline_ms 50 --safety 4"},
            .exit_codes = "0 success, 1 the deadline leaves no time to search, 2 invalid input or "
                          "an output that cannot be written"});
}

/// All problems that the scenario's controllers pose.
std::vector<hlc::search::HorizonProblem> problems_of(const hlc::scenario::Scenario& scenario) {
  hlc::rollout::Rollout rollout = hlc::rollout::make_rollout(scenario);
  std::vector<hlc::search::HorizonProblem> problems;
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    rollout.step();
    for (const auto& controller : rollout.controllers()) {
      std::ranges::transform(controller->problems(), std::back_inserter(problems),
                             &hlc::controller::SearchedProblem::problem);
    }
  }
  return problems;
}

/// No path has a free end, so the whole tree is searched.
hlc::search::HorizonProblem with_blocked_ends(hlc::search::HorizonProblem problem) {
  constexpr double kFar_m = 1e3;
  const hlc::Point at = problem.start.position_m();
  problem.obstacles_m.resize(problem.horizon_steps());
  problem.obstacles_m.back().push_back(
      hlc::convex_hull({at + hlc::Point(-kFar_m, -kFar_m), at + hlc::Point(kFar_m, -kFar_m),
                        at + hlc::Point(kFar_m, kFar_m), at + hlc::Point(-kFar_m, kFar_m)}));
  return problem;
}

/// The shortest time of some calls, without the load of other processes.
double time_s(hlc::search::SearchEngine& engine, const hlc::search::HorizonProblem& problem,
              std::size_t& expanded) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (int call = 0; call < kCalls; ++call) {
    const auto begin = Clock::now();
    expanded = engine.search(problem).expanded;
    shortest_s = std::min(shortest_s, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return shortest_s;
}

struct Measurements {
  double preparation_s{};         ///< longest search of few expansions
  std::vector<Measured> slowest;  ///< of each kind, per expansion
  [[nodiscard]] double rate_per_s() const {
    return std::ranges::min_element(slowest, {}, &Measured::rate_per_s)->rate_per_s();
  }
};

Measured measured(hlc::search::SearchEngine& engine, const hlc::search::HorizonProblem& problem,
                  std::string what) {
  Measured one{.what = std::move(what), .problems = 1};
  one.time_s = time_s(engine, problem, one.expansions);
  return one;
}

Measurements measure(const hlc::scenario::Scenario& scenario,
                     const std::vector<hlc::search::HorizonProblem>& problems) {
  const hlc::automaton::ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  hlc::search::SearchOptions options = scenario.search;
  options.max_expansions = kMeasured;
  const auto engine = hlc::search::make_search_engine(*scenario.subgraph, reachable, options);
  Measurements result;
  std::optional<Measured> ordinary;
  std::size_t informative = 0;
  for (const hlc::search::HorizonProblem& problem : problems) {
    const Measured one = measured(*engine, problem, "slowest of the scenario's");
    if (one.expansions < kInformative) {
      result.preparation_s = std::max(result.preparation_s, one.time_s);
      continue;
    }
    ++informative;
    if (!ordinary || one.rate_per_s() < ordinary->rate_per_s()) ordinary = one;
  }
  if (ordinary) {
    ordinary->problems = informative;
    result.slowest.push_back(*ordinary);
  }

  // The problem with the most obstacles and boundary, since each of them is checked; but one whose
  // way is not blocked at once.
  const auto size = [](const hlc::search::HorizonProblem& problem) {
    std::size_t count = problem.boundary_m.size();
    for (const auto& areas_m : problem.obstacles_m) count += areas_m.size();
    return count;
  };
  std::vector<const hlc::search::HorizonProblem*> by_size;
  for (const hlc::search::HorizonProblem& problem : problems) by_size.push_back(&problem);
  std::ranges::stable_sort(
      by_size, std::ranges::greater{},
      [&size](const hlc::search::HorizonProblem* problem) { return size(*problem); });
  for (const hlc::search::HorizonProblem* problem : by_size) {
    hlc::search::HorizonProblem hardest = with_blocked_ends(*problem);
    hardest.incumbent.clear();
    const Measured within_lanes = measured(*engine, hardest, "all ends blocked");
    if (within_lanes.expansions < kInformative) continue;
    result.slowest.push_back(within_lanes);
    hardest.boundary_m.clear();  // much more of the tree is free
    result.slowest.push_back(measured(*engine, hardest, "the same without lanes"));
    break;
  }
  return result;
}

void print(const Measured& one) {
  std::printf("%-26s %8zu %12zu %12.3f %18.0f\n", one.what.c_str(), one.problems, one.expansions,
              1e3 * one.time_s, one.rate_per_s());
}

/// Two leading digits, rounded down.
std::size_t rounded_down(double value) {
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
  return static_cast<std::size_t>(std::floor(value / unit) * unit);
}

int run(const Flags& flags) {
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(flags.scenario);
  const std::vector<hlc::search::HorizonProblem> problems = problems_of(scenario);
  if (problems.empty()) {
    throw std::invalid_argument(
        flags.scenario.file.string() +
        ": nothing is planned in its steps, must be a scenario that drives");
  }
  const Measurements found = measure(scenario, problems);
  if (found.slowest.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no search expands {} vertices, must be a scenario with harder searches",
                    flags.scenario.file.string(), kInformative));
  }
  std::printf(
      "%s: engine %s, cost-to-go %s, horizon %zu, subgraph %s; %zu problems of %zu steps\n\n",
      scenario.name.c_str(), hlc::scenario::engine_name(scenario.search).c_str(),
      hlc::search::to_string(scenario.search.cost_to_go), scenario.horizon_steps,
      scenario.subgraph->spec().name.c_str(), problems.size(), scenario.steps);
  std::printf("%-26s %8s %12s %12s %18s\n", "measured", "problems", "expansions", "time [ms]",
              "expansions per s");
  for (const Measured& one : found.slowest) print(one);
  std::printf("longest with fewer than %zu expansions: %.3f ms\n\n", kInformative,
              1e3 * found.preparation_s);

  const double rate_per_s = found.rate_per_s();
  const double search_s = 1e-3 * flags.deadline_ms / flags.safety - found.preparation_s;
  if (search_s * rate_per_s < 1.0) {
    std::cerr << "propose_budget: --deadline_ms = " << flags.deadline_ms
              << " leaves no time to search on this machine\n";
    return 1;
  }
  const std::size_t proposed = rounded_down(search_s * rate_per_s);
  std::printf("max_expansions: %zu   # (%g ms / safety %g - %.3f ms) at %.0f expansions per s\n",
              proposed, flags.deadline_ms, flags.safety, 1e3 * found.preparation_s, rate_per_s);
  std::printf("the scenario's %zu would take up to %.1f ms\n", scenario.search.max_expansions,
              1e3 * (found.preparation_s +
                     static_cast<double>(scenario.search.max_expansions) / rate_per_s));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Proposes max_expansions for a scenario: measures the expansions per second of its engine on "
      "this machine, with the scenario's problems and with one in which the whole tree is "
      "searched without a result, and takes the slowest.",
      "propose_budget"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("propose_budget", [&flags] { return run(flags); });
}
