// How long a whole run takes within one process: planning and coordination alone, with vehicles
// that follow perfectly, and with simulated vehicles, and where that time goes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/geometry/median.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace {

hlc::Nanoseconds wall_clock() {
  return static_cast<hlc::Nanoseconds>(
      std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count());
}

double since_ms(hlc::Nanoseconds from) { return 1e-6 * static_cast<double>(wall_clock() - from); }

/// All steps; making the controllers (their tables) is not timed: a run does it before its start.
double rollout_ms(const hlc::scenario::Scenario& scenario) {
  hlc::rollout::Rollout rollout = hlc::rollout::make_rollout(scenario);
  const hlc::Nanoseconds from = wall_clock();
  for (std::size_t i = 0; i < scenario.steps; ++i) static_cast<void>(rollout.step());
  return since_ms(from);
}

struct Times {
  std::vector<double> rollout_ms;
  std::vector<double> run_ms;  ///< with simulated vehicles; of it:
  std::vector<double> planning_ms;
  std::vector<double> coordination_ms;
  std::vector<double> vehicles_ms;
  std::vector<double> rest_ms;
};

void add_run(const hlc::scenario::Scenario& scenario, Times& times) {
  const hlc::closed_loop::Experiment experiment = hlc::closed_loop::drive_experiment(
      scenario, {.steps = scenario.steps, .clocks = {.wall = wall_clock}});
  const hlc::closed_loop::WallTimes& wall = experiment.wall;
  const double run_ms = 1e3 * experiment.facts.wall_s;
  times.run_ms.push_back(run_ms);
  times.planning_ms.push_back(1e3 * wall.planning_s);
  times.coordination_ms.push_back(1e3 * wall.coordination_s);
  times.vehicles_ms.push_back(1e3 * wall.vehicles_s);
  times.rest_ms.push_back(run_ms - 1e3 * (wall.planning_s + wall.coordination_s + wall.vehicles_s));
}

void print(const char* what, const std::vector<double>& sample, double run_s) {
  const double median = hlc::median(sample);
  std::printf("%-46s %8.2f %8.2f %8.2f", what, std::ranges::min(sample), median,
              std::ranges::max(sample));
  if (run_s > 0.0) std::printf(" %10.0f", 1e3 * run_s / median);
  std::printf("\n");
}

void run(const hlc::scenario::ScenarioChoices& choices, std::size_t repeats) {
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
  const double run_s = static_cast<double>(scenario.steps) * scenario.subgraph->automaton().step_s;
  Times times;
  for (std::size_t i = 0; i < repeats; ++i) {
    times.rollout_ms.push_back(rollout_ms(scenario));
    add_run(scenario, times);
  }
  std::printf("%s, subgraph %s, profile %s: %zu vehicles, %zu steps, %zu repeats, wall time [ms]\n",
              scenario.name.c_str(), scenario.subgraph->spec().name.c_str(),
              scenario.profile.name.c_str(), scenario.vehicles.size(), scenario.steps, repeats);
  std::printf("%-46s %8s %8s %8s %10s\n", "", "min", "median", "max", "x realtime");
  print("planning and coordination (perfect vehicles)", times.rollout_ms, run_s);
  print("whole run with simulated vehicles", times.run_ms, run_s);
  print("  planning", times.planning_ms, 0.0);
  print("  coordination", times.coordination_ms, 0.0);
  print("  simulated vehicles", times.vehicles_ms, 0.0);
  print("  rest (messages, lab control)", times.rest_ms, 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{"Times whole runs of a scenario within this process.",
                             "run_benchmark"};
  hlc::scenario::ScenarioChoices choices;
  std::size_t repeats = 20;
  hlc::apps::declare_scenario_flags(app, choices);
  app.get_option("--scenario")
      ->required(false)
      ->run_callback_for_default()
      ->default_val("paper_three_cars");
  app.add_option("--steps", choices.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  app.add_option("--repeats", repeats, "how often")
      ->check(hlc::apps::whole(1, 10000))
      ->capture_default_str();
  hlc::apps::declare_help_end(
      app,
      {.examples = {"run_benchmark", "run_benchmark --scenario lab_cars --cars 20 --repeats 3"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("run_benchmark", [&] { run(choices, repeats); });
}
