#include "vehicle_sim/campaign/paper_table.hpp"

namespace hlc::campaign {
namespace {

/// [%]
std::optional<double> share_of_wall(const RunFigures& run, double part_s) {
  return run.wall_s > 0.0 ? std::optional(100.0 * part_s / run.wall_s) : std::nullopt;
}

/// Of the vehicle of highest priority.
std::vector<TableQuantity> accuracy_and_lap() {
  return {
      {"Reference error of planned positions, mean [mm]",
       "error_mean_mm",
       1,
       [](const RunFigures& run) { return run.error_mean_mm; },
       {{kPaperSimulation, {{"A", 40.1}, {"B", 30.7}, {"C", 30.8}, {"D", 19.4}}},
        {kPaperLab, {{"B", 27.9}, {"C", 19.9}, {"D", 17.0}}}}},
      {"Reference error of planned positions, standard deviation [mm]",
       "error_std_mm",
       1,
       [](const RunFigures& run) { return run.error_std_mm; },
       {{kPaperSimulation, {{"A", 35.9}, {"B", 28.9}, {"C", 28.8}, {"D", 17.6}}},
        {kPaperLab, {{"B", 30.5}, {"C", 23.7}, {"D", 16.1}}}}},
      {"Reference error of driven positions, mean [mm]",
       "driven_error_mean_mm",
       1,
       [](const RunFigures& run) { return run.driven_error_mean_mm; },
       {}},
      {"Reference error of driven positions, standard deviation [mm]",
       "driven_error_std_mm",
       1,
       [](const RunFigures& run) { return run.driven_error_std_mm; },
       {}},
      {"Time for one lap [s]",
       "lap_s",
       2,
       [](const RunFigures& run) { return run.lap_s; },
       {{kPaperSimulation, {{"A", 13.8}, {"B", 15.8}, {"C", 15.8}, {"D", 16.2}}},
        {kPaperLab, {{"B", 15.8}, {"C", 16.0}, {"D", 16.0}}}}},
      {"Starts in which it drove a lap [%]",
       "lap_driven_percent",
       0,
       [](const RunFigures& run) { return std::optional(run.lap_s ? 100.0 : 0.0); },
       {}},
  };
}

std::vector<TableQuantity> search_effort() {
  return {
      {"Max. generated vertices, one car",
       "generated_max",
       0,
       [](const RunFigures& run) { return std::optional(run.generated_max); },
       {{kPaperLab, {{"B", 430.0}, {"C", 322.0}, {"D", 291.0}}}}},
      {"Max. generated vertices, sum of the cars of a step",
       "generated_sum_max",
       0,
       [](const RunFigures& run) { return std::optional(run.generated_sum_max); },
       {{kPaperSimulation, {{"A", 159114.0}, {"B", 1966.0}, {"C", 1969.0}, {"D", 879.0}}}}},
      {"Max. expanded vertices, one car",
       "expanded_max",
       0,
       [](const RunFigures& run) { return std::optional(run.expanded_max); },
       {}},
      {"Max. expanded vertices, sum of the cars of a step",
       "expanded_sum_max",
       0,
       [](const RunFigures& run) { return std::optional(run.expanded_sum_max); },
       {}},
      {"Computation time, mean [ms]",
       "planning_mean_ms",
       3,
       [](const RunFigures& run) { return std::optional(run.planning_mean_ms); },
       {{kPaperSimulation, {{"A", 9738.3}, {"B", 125.0}, {"C", 166.5}, {"D", 138.4}}},
        {kPaperLab, {{"B", 12.4}, {"C", 11.8}, {"D", 10.2}}}},
       true},
      {"Computation time, standard deviation [ms]",
       "planning_std_ms",
       3,
       [](const RunFigures& run) { return std::optional(run.planning_std_ms); },
       {{kPaperSimulation, {{"A", 5228.1}, {"B", 67.5}, {"C", 80.1}, {"D", 71.2}}},
        {kPaperLab, {{"B", 3.8}, {"C", 3.1}, {"D", 3.3}}}},
       true},
      {"Max. computation time [ms]",
       "planning_max_ms",
       3,
       [](const RunFigures& run) { return std::optional(run.planning_max_ms); },
       {{kPaperSimulation, {{"A", 28436.7}, {"B", 600.9}, {"C", 570.7}, {"D", 654.4}}},
        {kPaperLab, {{"B", 32.3}, {"C", 24.5}, {"D", 32.8}}}},
       true},
      {"Plans that took longer than a step [%]",
       "exceeding_step_percent",
       2,
       [](const RunFigures& run) { return std::optional(100.0 * run.exceeding_step_share); },
       {}},
      {"Computation time of a step of all cars, 99 % [ms]",
       "step_p99_ms",
       2,
       [](const RunFigures& run) { return std::optional(run.step_p99_ms); },
       {}},
      {"Max. computation time of a step of all cars [ms]",
       "step_max_ms",
       2,
       [](const RunFigures& run) { return std::optional(run.step_max_ms); },
       {}},
  };
}

std::vector<TableQuantity> waiting() {
  return {
      {"Longest wait for other cars [s]",
       "longest_wait_s",
       1,
       [](const RunFigures& run) { return std::optional(run.longest_wait_s); },
       {}},
      {"Runs with a car stuck at the end [%]",
       "stuck_percent",
       0,
       [](const RunFigures& run) { return std::optional(run.stuck_vehicles > 0 ? 100.0 : 0.0); },
       {}},
  };
}

std::vector<TableQuantity> whole_run() {
  return {
      {"Fallback steps",
       "fallback_steps",
       0,
       [](const RunFigures& run) { return std::optional(static_cast<double>(run.fallback_steps)); },
       {}},
      {"Collisions",
       "collisions",
       0,
       [](const RunFigures& run) { return std::optional(static_cast<double>(run.collisions)); },
       {}},
      {"Largest deviation from the plan [mm]",
       "deviation_max_mm",
       1,
       [](const RunFigures& run) { return std::optional(run.deviation_max_mm); },
       {}},
      {"Effort J2 per driven metre, all cars",
       "effort_per_m",
       3,
       [](const RunFigures& run) { return run.effort_per_m; },
       {}},
      {"Criterion comfort per driven metre, all cars",
       "comfort_per_m",
       3,
       [](const RunFigures& run) { return run.comfort_per_m; },
       {}},
      {"Wall time of the whole run [ms]",
       "wall_ms",
       1,
       [](const RunFigures& run) { return std::optional(1e3 * run.wall_s); },
       {}},
      {"- in planning [%]",
       "wall_planning_percent",
       1,
       [](const RunFigures& run) { return share_of_wall(run, run.wall_planning_s); },
       {}},
      {"- in coordination [%]",
       "wall_coordination_percent",
       1,
       [](const RunFigures& run) { return share_of_wall(run, run.wall_coordination_s); },
       {}},
      {"- in the simulated vehicles [%]",
       "wall_vehicles_percent",
       1,
       [](const RunFigures& run) { return share_of_wall(run, run.wall_vehicles_s); },
       {}},
  };
}

}  // namespace

const std::vector<TableQuantity>& table_quantities() {
  static const std::vector<TableQuantity> all = [] {
    std::vector<TableQuantity> rows = accuracy_and_lap();
    for (const auto& more : {search_effort(), waiting(), whole_run()}) {
      rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
  }();
  return all;
}

std::optional<double> papers_value(const TableQuantity& quantity, const std::string& scenario,
                                   const std::string& subgraph) {
  const auto of_scenario = quantity.paper.find(scenario);
  if (of_scenario == quantity.paper.end()) return std::nullopt;
  const auto value = of_scenario->second.find(subgraph);
  return value == of_scenario->second.end() ? std::nullopt : std::optional(value->second);
}

std::vector<PapersCell> papers_cells() {
  std::vector<PapersCell> cells;
  for (const std::string& scenario : {std::string(kPaperSimulation), std::string(kPaperLab)}) {
    for (const std::string subgraph : {"A", "B", "C", "D"}) {
      for (const TableQuantity& quantity : table_quantities()) {
        const std::optional<double> value = papers_value(quantity, scenario, subgraph);
        if (!value || quantity.depends_on_machine) continue;
        cells.push_back({scenario, subgraph, quantity.key, *value, quantity.of});
      }
    }
  }
  return cells;
}

}  // namespace hlc::campaign
