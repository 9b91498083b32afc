// The authors' experiment with many cars, for every priority strategy: planning time of the whole
// lab, computation levels, costs against the optimal order, deadlocks.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/priority_files.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/apps/result_folder.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "planner/rollout/priority_trial.hpp"
#include "planner/scenario/priority_values.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"

namespace {

using hlc::rollout::PriorityTrial;

constexpr double kMillisecondsPerSecond = 1e3;
constexpr double kPercent = 100.0;

struct Flags {
  hlc::scenario::ScenarioChoices scenario;
  std::vector<std::size_t> cars;
  std::vector<std::string> strategies;  ///< empty: all that suit the coordination
  std::size_t draws{3};
  std::optional<std::size_t> max_levels;
  std::filesystem::path out;  ///< empty: nothing is written
  bool makes_report{};
};

/// One cell of the experiment.
struct Cell {
  std::size_t cars{};
  std::string strategy;
  std::vector<PriorityTrial> trials;  ///< one for each draw
};

void declare(CLI::App& app, Flags& flags) {
  hlc::apps::declare_scenario(app, "SCENARIO,--scenario", flags.scenario.file)->required();
  app.add_option("--cars", flags.cars, "numbers of cars, N,N,...; default: the scenario's")
      ->delimiter(',')
      ->check(hlc::apps::whole(1, hlc::kMaxVehicleId));
  app.add_option("--priorities", flags.strategies,
                 "NAME,NAME,... (default: all that suit the coordination): " +
                     hlc::scenario::priority_strategies_text())
      ->delimiter(',')
      ->check(hlc::apps::among(hlc::coordination::priority_strategy_names()));
  app.add_option("--draws", flags.draws,
                 "of the cars of a scenario that draws them, seeds 1, 2, ...; others have one")
      ->check(hlc::apps::whole(1, 10'000))
      ->capture_default_str();
  app.add_option("--max_levels", flags.max_levels,
                 "most computation levels; default: the scenario's")
      ->check(hlc::apps::whole(1, 100));
  app.add_option("--steps", flags.scenario.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100'000));
  hlc::apps::declare_profile_flag(app, flags.scenario.profile);
  CLI::Option* const out = app.add_option(
      "--out", flags.out,
      "folder for the rows of all runs, steps and joint gaps (runs.csv, steps.csv, gaps.csv, "
      "campaign.json); existing files of these names are replaced");
  out->type_name("DIR");
  app.add_flag("--report", flags.makes_report,
               "also makes the page OUT/report.md from the rows: tables and figures "
               "(vehicle_sim/report; its Python packages are installed once)")
      ->needs(out);
  hlc::apps::declare_help_end(
      app, {.examples = {"compare_priorities lab_cars --cars 5,10,15,20 --steps 35",
                         "compare_priorities lab_cars --priorities constant,fca --draws 5 --out "
                         "runs/priorities --report"},
            .exit_codes = "0 success, 2 invalid input or an output that cannot be written, 3 all "
                          "but the report, 130 interrupted"});
}

/// Processor time: what else the machine does is not measured.
double now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// With the cars of the scenario's own draw.
hlc::scenario::Scenario read(const Flags& flags, std::size_t cars) {
  hlc::scenario::ScenarioChoices choices = flags.scenario;
  if (cars != 0) choices.cars = cars;
  hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
  if (flags.max_levels) {
    scenario.profile.strategies.priorities.max_levels = *flags.max_levels;
  }
  return scenario;
}

/// The scenario with other cars drawn. @param draw  0: as it is
hlc::scenario::Scenario drawn(const hlc::scenario::Scenario& scenario, std::size_t draw) {
  return draw == 0 ? scenario : hlc::scenario::with_random_starts(scenario, draw);
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

/// Of all trials of a cell.
struct Figures {
  std::vector<double> step_ms;
  std::size_t levels_sum{};
  std::size_t levels_max{};
  double driven_m{};
  std::size_t driven_steps{};  ///< of all vehicles, from the second step of a run on
  std::size_t planned{};
  std::size_t vehicle_steps{};
  std::size_t deadlocked{};
  double cost_m2{};
  double optimal_order_m2{};
  std::size_t compared{};
  std::size_t worse{};
  std::vector<hlc::coordination::JointGap> gaps;
};

Figures figures_of(const std::vector<PriorityTrial>& trials) {
  Figures sum;
  for (const PriorityTrial& one : trials) {
    for (const double step_s : one.step_s) sum.step_ms.push_back(kMillisecondsPerSecond * step_s);
    for (const std::size_t levels : one.levels) {
      sum.levels_sum += levels;
      sum.levels_max = std::max(sum.levels_max, levels);
    }
    sum.driven_m += one.driven_m;
    sum.driven_steps += one.vehicle_steps - one.vehicle_steps / one.step_s.size();
    sum.planned += one.planned;
    sum.vehicle_steps += one.vehicle_steps;
    if (one.deadlock_step) ++sum.deadlocked;
    sum.cost_m2 += one.cost_m2;
    sum.optimal_order_m2 += one.optimal_order_m2;
    sum.compared += one.compared_steps;
    sum.worse += one.worse_steps;
    std::ranges::copy(one.gaps, std::back_inserter(sum.gaps));
  }
  return sum;
}

std::string row_of(const Cell& cell, double period_s) {
  const Figures all = figures_of(cell.trials);
  const auto steps = static_cast<double>(all.step_ms.size());
  const auto vehicle_steps = static_cast<double>(all.vehicle_steps);
  const auto gaps = hlc::coordination::joint_gap_figures(all.gaps);
  return fmt::format(
      "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {} | {:.1f} | {:.3f} | {} of {} | {} | {} | "
      "{} |\n",
      cell.cars, cell.strategy,
      std::accumulate(all.step_ms.begin(), all.step_ms.end(), 0.0) / steps,
      quantile(all.step_ms, 0.5), quantile(all.step_ms, 0.99),
      static_cast<double>(all.levels_sum) / steps, all.levels_max,
      kPercent * static_cast<double>(all.planned) / vehicle_steps,
      all.driven_m / static_cast<double>(std::max<std::size_t>(all.driven_steps, 1)) / period_s,
      all.deadlocked, cell.trials.size(),
      all.compared == 0
          ? "-"
          : fmt::format("{:.4f} ({})", all.cost_m2 / all.optimal_order_m2, all.compared),
      all.worse,
      gaps ? fmt::format(
                 "{} / {} / {:.1f} %", hlc::coordination::excess_text(gaps->total),
                 hlc::coordination::excess_text(gaps->p99),
                 kPercent * static_cast<double>(gaps->closed) / static_cast<double>(gaps->known))
           : "-");
}

constexpr const char* kHeading =
    "| cars | strategy | step, all cars [ms]: mean | median | p99 | levels: mean | max | new plans "
    "[%] | "
    "speed [m/s] | deadlocked runs | cost / optimal order (steps) | steps with fewer plans | above "
    "the joint optimum, at most: in all / in 99 % / proven to be it |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

constexpr const char* kLegend =
    "\nstep: processor time of planning and coordination of all cars, one after the other in one "
    "process. "
    "deadlocked: "
    "a car stood for three horizons, also one that has arrived.\ncost / optimal order: of the same "
    "step from the same situation, "
    "where no more than 5 cars are coupled and as many found a plan;\nsteps with fewer "
    "plans than in the optimal order. above the joint optimum: sum of the costs against the sum of "
    "the bounds.\n";

/// Draws are of scenarios that draw their cars.
std::vector<std::size_t> draws_of(const Flags& flags, const hlc::scenario::Scenario& scenario) {
  if (scenario.candidates.empty()) return {0};
  std::vector<std::size_t> draws;
  for (std::size_t draw = 1; draw <= flags.draws; ++draw) draws.push_back(draw);
  return draws;
}

/// Refuses what the scenario's coordination does not allow; chooses what it does.
void choose_strategies(Flags& flags, const hlc::scenario::Scenario& scenario) {
  const hlc::controller::CoordinationRule& coordination = scenario.profile.strategies.coordination;
  if (coordination.commit.needs_votes && flags.max_levels) {
    throw std::invalid_argument(fmt::format("--max_levels = {}, must be absent {}",
                                            *flags.max_levels, hlc::scenario::kWithVotes));
  }
  std::vector<std::string> suitable;
  for (const auto* one : hlc::coordination::priority_strategies()) {
    if (!coordination.commit.needs_votes || one->search == nullptr) {
      suitable.emplace_back(one->name);
    }
  }
  if (flags.strategies.empty()) flags.strategies = suitable;
  for (const std::string& name : flags.strategies) {
    if (std::ranges::find(suitable, name) != suitable.end()) continue;
    throw std::invalid_argument(fmt::format("--priorities = {}, must be of {} {}", name,
                                            fmt::join(suitable, ", "), hlc::scenario::kWithVotes));
  }
}

/// All draws of all strategies with so many cars.
std::vector<Cell> drive(const hlc::scenario::Scenario& scenario,
                        const std::vector<std::string>& strategies,
                        const std::vector<std::size_t>& draws,
                        const hlc::apps::ProgressLine& progress, std::size_t& done) {
  std::vector<Cell> cells;
  for (const std::string& strategy : strategies) {
    cells.push_back({.cars = scenario.vehicles.size(), .strategy = strategy, .trials = {}});
  }
  for (const std::size_t draw : draws) {
    hlc::scenario::Scenario one = drawn(scenario, draw);
    for (Cell& cell : cells) {
      one.profile.strategies.priorities.strategy =
          hlc::coordination::priority_strategy(cell.strategy);
      cell.trials.push_back(hlc::rollout::try_priorities(one, true, now_s));
      progress.show(++done);
    }
  }
  return cells;
}

void write(const Flags& flags, const std::string& command, const hlc::scenario::Scenario& scenario,
           const std::vector<std::size_t>& draws, std::vector<Cell> cells) {
  hlc::apps::PriorityPlan plan{.strategies = flags.strategies, .cars = {}, .draws = draws};
  std::vector<hlc::apps::PriorityRun> runs;
  for (Cell& cell : cells) {
    if (plan.cars.empty() || plan.cars.back() != cell.cars) plan.cars.push_back(cell.cars);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      runs.push_back({.cars = cell.cars,
                      .strategy = cell.strategy,
                      .draw = draws[i],
                      .trial = std::move(cell.trials[i])});
    }
  }
  hlc::apps::write_priority_files(flags.out, hlc::apps::origin_of(command), scenario, plan, runs);
}

int run(Flags flags, const std::string& command) {
  hlc::apps::check_each_once("--cars", flags.cars);
  hlc::apps::check_each_once("--priorities", flags.strategies);
  if (flags.cars.empty()) flags.cars = {0};
  std::vector<hlc::scenario::Scenario> scenarios;  // all, before anything is driven
  for (const std::size_t cars : flags.cars) scenarios.push_back(read(flags, cars));
  const hlc::scenario::Scenario& any = scenarios.front();
  choose_strategies(flags, any);
  if (!flags.out.empty()) hlc::apps::prepare_priority_folder(flags.out);
  const std::vector<std::size_t> draws = draws_of(flags, any);
  const hlc::apps::Interruption interruption(
      "compare_priorities",
      "no rows are written yet: the same command begins from the start, --draws shortens it");
  const hlc::apps::ProgressLine progress(
      "run", flags.cars.size() * flags.strategies.size() * draws.size());
  std::vector<Cell> cells;
  std::size_t done = 0;
  for (const hlc::scenario::Scenario& scenario : scenarios) {
    std::ranges::move(drive(scenario, flags.strategies, draws, progress, done),
                      std::back_inserter(cells));
  }
  std::string table = kHeading;
  for (const Cell& cell : cells) table += row_of(cell, any.subgraph->automaton().step_s);
  const std::string result =
      fmt::format("{}: {} steps of {:g} s, horizon {}, subgraph {} of {} trims, {} draws{}\n\n{}{}",
                  any.name, any.steps, any.subgraph->automaton().step_s, any.horizon_steps,
                  any.subgraph->spec().name, any.subgraph->spec().trims.size(), draws.size(),
                  flags.max_levels ? fmt::format(", at most {} levels", *flags.max_levels) : "",
                  table, kLegend);
  fmt::print("{}", hlc::apps::fitted_table(result));
  if (!flags.out.empty()) write(flags, command, any, draws, std::move(cells));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Drives a scenario with every priority strategy, in one process with cars that follow "
      "perfectly.",
      "compare_priorities"};
  Flags flags;
  declare(app, flags);
  if (const auto code =
          hlc::apps::parse_flags(app, argc, argv, {{"--strategies", "--priorities"}})) {
    return *code;
  }
  const int code = hlc::apps::exit_code_of(
      "compare_priorities", [&] { return run(flags, hlc::apps::command_line(argc, argv)); });
  if (code != 0 || !flags.makes_report) return code;
  return hlc::apps::make_report("compare_priorities", flags.out) ? 0 : hlc::apps::kExitNoReport;
}
