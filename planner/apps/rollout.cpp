// Planning and coordination without DDS and vehicle dynamics: all controllers of a scenario in one
// process, with vehicles that follow their plans perfectly. For a quick check of a scenario.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/road/lap.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_engine.hpp"

namespace {

constexpr int kExitFailed = 2;

struct Tally {
  std::vector<hlc::Point> positions_m;  ///< planned, at the steps
  std::uint64_t generated_max{};
  std::uint64_t expanded_max{};
  int fallbacks{};
  double longest_wait_s{};
  hlc::coordination::Report last;
  int changed{};  ///< steps in which the others changed the plan
};

void add(Tally& tally, const hlc::coordination::Report& report, double step_s) {
  tally.positions_m.push_back(report.planned_pose.position_m());
  tally.generated_max = std::max(tally.generated_max, report.generated);
  tally.expanded_max = std::max(tally.expanded_max, report.expanded);
  if (report.status == hlc::coordination::StepStatus::kFallback) ++tally.fallbacks;
  tally.longest_wait_s = std::max(tally.longest_wait_s, hlc::coordination::wait_s(report, step_s));
  tally.last = report;
}

void print(const Tally& tally, const hlc::scenario::ScenarioVehicle& vehicle, double step_s) {
  const hlc::road::Progress progress = hlc::road::progress_along(vehicle.path, tally.positions_m);
  std::vector<double> times_s;
  double sum_m = 0.0;
  double max_m = 0.0;
  for (const double distance_m : progress.distance_m) {
    times_s.push_back(step_s * static_cast<double>(times_s.size()));
    sum_m += distance_m;
    max_m = std::max(max_m, distance_m);
  }
  const std::optional<double> lap_s =
      hlc::road::lap_s(vehicle.path, progress, times_s, hlc::road::kFirstStepDriven);
  const std::string lap = lap_s ? fmt::format("{:.2f}", *lap_s) : "-";
  std::printf("%-10s %8s %12.1f %11.1f %14llu %13llu %10d %8d %9.1f\n", vehicle.name.c_str(),
              lap.c_str(), 1e3 * sum_m / static_cast<double>(times_s.size()), 1e3 * max_m,
              static_cast<unsigned long long>(tally.generated_max),
              static_cast<unsigned long long>(tally.expanded_max), tally.fallbacks, tally.changed,
              tally.longest_wait_s);
}

/// True if the plan of this step would be different without the other vehicles.
bool others_changed_the_plan(const hlc::controller::Controller& controller,
                             hlc::search::SearchEngine& alone,
                             const hlc::coordination::Report& report) {
  if (controller.problems().empty() || report.status != hlc::coordination::StepStatus::kPlanned)
    return false;
  hlc::search::HorizonProblem problem = controller.problems().back();
  problem.obstacles_m.clear();
  return alone.search(problem).cost < report.cost_m2 - 1e-9;
}

int run(const hlc::scenario::ScenarioChoices& choices) {
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
  const double step_s = scenario.subgraph->automaton().step_s;
  std::map<hlc::VehicleId, Tally> tallies;
  hlc::rollout::Rollout rollout = hlc::rollout::make_rollout(scenario);
  const hlc::automaton::ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  const auto alone =
      hlc::search::make_search_engine(*scenario.subgraph, reachable, scenario.search);
  std::chrono::steady_clock::duration wall{};
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<hlc::coordination::Report> reports = rollout.step();
    wall += std::chrono::steady_clock::now() - begin;
    for (std::size_t j = 0; j < reports.size(); ++j) {
      hlc::coordination::Report& report = reports[j];
      rollout.controllers()[j]->note_causes(report);
      Tally& tally = tallies[report.vehicle];
      add(tally, report, step_s);
      if (others_changed_the_plan(*rollout.controllers()[j], *alone, report)) ++tally.changed;
    }
  }
  const double wall_ms = 1e3 * std::chrono::duration<double>(wall).count();

  std::printf("%-10s %8s %12s %11s %14s %13s %10s %8s %9s\n", "vehicle", "lap [s]", "error [mm]",
              "max [mm]", "max generated", "max expanded", "fallbacks", "changed", "wait [s]");
  for (const auto& [id, tally] : tallies)
    print(tally, hlc::scenario::vehicle_of(scenario, id), step_s);
  std::printf(
      "changed: steps in which the others changed the vehicle's plan; wait: the longest, of a "
      "vehicle that stood\nthough without the others it would have driven\n");
  for (const auto& [id, tally] : tallies) {
    if (!hlc::coordination::is_stuck(tally.last, step_s)) continue;
    std::printf("stuck at the end: %s\n",
                hlc::coordination::waiting_text(tally.last, step_s).c_str());
  }
  std::printf("%zu steps in %.1f ms\n", scenario.steps, wall_ms);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Plans a scenario with vehicles that follow perfectly, in one process.", "rollout"};
  hlc::scenario::ScenarioChoices choices;
  hlc::apps::declare_scenario_flags(app, choices);
  app.add_option("--steps", choices.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  app.footer("Exit codes: 0 success, 2 invalid input or an output that cannot be written.");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, kExitFailed)) return *code;
  return hlc::apps::exit_code_of(
      "rollout", [&choices] { return run(choices); }, kExitFailed);
}
