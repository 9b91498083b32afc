// Planning and coordination alone: all controllers of a scenario in one process, with vehicles that
// follow their plans perfectly. For a quick look at a scenario, without DDS and without vehicle
// dynamics.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>

#include "planner/apps/flags.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

struct Tally {
  double error_sum_mm{};
  double error_max_mm{};
  double last_s_m{};
  double way_m{};
  double lap_s{-1.0};
  std::uint64_t generated_max{};
  std::uint64_t expanded_max{};
  int fallbacks{};
  int changed{};  ///< steps in which the others changed the plan
};

void add(Tally& tally, const hlc::Report& report, const hlc::ScenarioVehicle& vehicle,
         double time_s, double step_s) {
  const auto projection = vehicle.path.project_within(report.planned_pose.position_m(),
                                                      tally.last_s_m - 0.3, tally.last_s_m + 1.0);
  const double error_mm = 1e3 * projection.distance_m;
  tally.error_sum_mm += error_mm;
  tally.error_max_mm = std::max(tally.error_max_mm, error_mm);
  const double length = vehicle.path.length_m();
  double moved = projection.s_m - tally.last_s_m;
  if (vehicle.path.is_closed()) moved -= length * std::round(moved / length);
  if (tally.lap_s < 0.0 && vehicle.path.is_closed() && tally.way_m + moved >= length) {
    tally.lap_s = time_s - step_s * (tally.way_m + moved - length) / moved;
  }
  tally.way_m += moved;
  tally.last_s_m = projection.s_m;
  tally.generated_max = std::max(tally.generated_max, report.generated);
  tally.expanded_max = std::max(tally.expanded_max, report.expanded);
  if (report.status == hlc::StepStatus::kFallback) ++tally.fallbacks;
}

/// True if the plan of this step would have been another one without the other vehicles.
bool others_changed_the_plan(const hlc::Controller& controller, hlc::HorizonPlanner& alone,
                             const hlc::Report& report) {
  if (!controller.problem() || report.status != hlc::StepStatus::kPlanned) return false;
  hlc::HorizonProblem problem = *controller.problem();
  problem.obstacles_m.clear();
  return alone.plan(problem).cost < report.cost_m2 - 1e-9;
}

int run(const hlc::ScenarioChoices& choices) {
  const hlc::Scenario scenario = hlc::read_scenario(choices);
  const double step_s = scenario.subgraph->automaton().step_s;
  std::vector<std::unique_ptr<hlc::Controller>> controllers;
  std::vector<hlc::Pose> starts;
  std::map<hlc::VehicleId, Tally> tallies;
  for (const hlc::ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(hlc::make_controller(scenario, vehicle.id));
    starts.push_back(vehicle.start);
    tallies[vehicle.id].last_s_m = vehicle.start_s_m;
  }
  hlc::Rollout rollout(std::move(controllers), starts);
  const hlc::ReachableSets reachable(*scenario.subgraph, scenario.horizon_steps);
  const auto alone = hlc::make_best_first_planner(
      *scenario.subgraph, reachable,
      {.cost_to_go = scenario.profile.cost_to_go, .max_expansions = scenario.max_expansions});
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    const std::vector<hlc::Report> reports = rollout.step();
    for (std::size_t j = 0; j < reports.size(); ++j) {
      const hlc::Report& report = reports[j];
      Tally& tally = tallies.at(report.vehicle);
      add(tally, report, hlc::vehicle_of(scenario, report.vehicle), static_cast<double>(i) * step_s,
          step_s);
      if (others_changed_the_plan(*rollout.controllers()[j], *alone, report)) ++tally.changed;
    }
  }
  const double wall_ms =
      1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  std::printf("%-10s %8s %12s %11s %14s %13s %10s %8s\n", "vehicle", "lap [s]", "error [mm]",
              "max [mm]", "max generated", "max expanded", "fallbacks", "changed");
  for (const auto& [id, tally] : tallies) {
    std::printf("%-10s %8s %12.1f %11.1f %14llu %13llu %10d %8d\n",
                hlc::vehicle_of(scenario, id).name.c_str(),
                tally.lap_s < 0.0 ? "-" : std::to_string(tally.lap_s).substr(0, 6).c_str(),
                tally.error_sum_mm / static_cast<double>(scenario.steps), tally.error_max_mm,
                static_cast<unsigned long long>(tally.generated_max),
                static_cast<unsigned long long>(tally.expanded_max), tally.fallbacks,
                tally.changed);
  }
  std::printf("changed: steps in which the others changed the vehicle's plan\n");
  std::printf("%zu steps in %.1f ms\n", scenario.steps, wall_ms);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Plans a scenario with vehicles that follow perfectly, in one process.", "rollout"};
  hlc::ScenarioChoices choices;
  hlc::declare_scenario_flags(app, choices);
  app.add_option("--steps", choices.steps, "instead of the scenario's")
      ->check(CLI::Range(1, 100000));
  app.footer("Exit codes: 0 good, 2 bad input.");
  if (const auto code = hlc::parse_flags(app, argc, argv)) return *code;
  try {
    return run(choices);
  } catch (const std::exception& error) {
    std::cerr << "rollout: " << error.what() << '\n';
    return 2;
  }
}
