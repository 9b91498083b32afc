#include "vehicle_sim/campaign/evaluation_table.hpp"

#include <algorithm>
#include <map>

#include "vehicle_sim/campaign/number_text.hpp"

namespace hlc {
namespace {

/// A quantity of the table: its name, unit and decimals, how to get it from a run, and what the
/// paper's Table 2 has, by scenario and subgraph.
struct Quantity {
  std::string name;
  std::string key;
  int decimals;
  std::optional<double> (*of)(const RunFigures&);
  std::map<std::string, std::map<std::string, double>> paper;
  bool depends_on_machine{};
};

const std::string kSimulation = "paper_three_cars";
const std::string kLab = "paper_red_alone";

/// [%]
std::optional<double> share_of_wall(const RunFigures& run, double part_s) {
  return run.wall_s > 0.0 ? std::optional(100.0 * part_s / run.wall_s) : std::nullopt;
}

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all{
      {"Reference error of planned positions, mean [mm]",
       "error_mean_mm",
       1,
       [](const RunFigures& run) { return run.error_mean_mm; },
       {{kSimulation, {{"A", 40.1}, {"B", 30.7}, {"C", 30.8}, {"D", 19.4}}},
        {kLab, {{"B", 27.9}, {"C", 19.9}, {"D", 17.0}}}}},
      {"Reference error of planned positions, standard deviation [mm]",
       "error_std_mm",
       1,
       [](const RunFigures& run) { return run.error_std_mm; },
       {{kSimulation, {{"A", 35.9}, {"B", 28.9}, {"C", 28.8}, {"D", 17.6}}},
        {kLab, {{"B", 30.5}, {"C", 23.7}, {"D", 16.1}}}}},
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
       {{kSimulation, {{"A", 13.8}, {"B", 15.8}, {"C", 15.8}, {"D", 16.2}}},
        {kLab, {{"B", 15.8}, {"C", 16.0}, {"D", 16.0}}}}},
      {"Starts in which it drove a lap [%]",
       "lap_driven_percent",
       0,
       [](const RunFigures& run) { return std::optional(run.lap_s ? 100.0 : 0.0); },
       {}},
      {"Max. generated vertices, one car",
       "generated_max",
       0,
       [](const RunFigures& run) { return std::optional(run.generated_max); },
       {{kLab, {{"B", 430.0}, {"C", 322.0}, {"D", 291.0}}}}},
      {"Max. generated vertices, sum of the cars of a step",
       "generated_sum_max",
       0,
       [](const RunFigures& run) { return std::optional(run.generated_sum_max); },
       {{kSimulation, {{"A", 159114.0}, {"B", 1966.0}, {"C", 1969.0}, {"D", 879.0}}}}},
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
       {{kSimulation, {{"A", 9738.3}, {"B", 125.0}, {"C", 166.5}, {"D", 138.4}}},
        {kLab, {{"B", 12.4}, {"C", 11.8}, {"D", 10.2}}}},
       true},
      {"Computation time, standard deviation [ms]",
       "planning_std_ms",
       3,
       [](const RunFigures& run) { return std::optional(run.planning_std_ms); },
       {{kSimulation, {{"A", 5228.1}, {"B", 67.5}, {"C", 80.1}, {"D", 71.2}}},
        {kLab, {{"B", 3.8}, {"C", 3.1}, {"D", 3.3}}}},
       true},
      {"Max. computation time [ms]",
       "planning_max_ms",
       3,
       [](const RunFigures& run) { return std::optional(run.planning_max_ms); },
       {{kSimulation, {{"A", 28436.7}, {"B", 600.9}, {"C", 570.7}, {"D", 654.4}}},
        {kLab, {{"B", 32.3}, {"C", 24.5}, {"D", 32.8}}}},
       true},
      {"Plans that took longer than a step [%]",
       "overlong_percent",
       2,
       [](const RunFigures& run) { return std::optional(100.0 * run.overlong_share); },
       {}},
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
  return all;
}

/// A quantity over the starts.
struct Spread {
  std::size_t count{};
  double mean{};
  double min{};
  double max{};
};

Spread spread_of(const Quantity& quantity, const std::vector<const RunFigures*>& runs) {
  Spread spread;
  for (const RunFigures* run : runs) {
    const std::optional<double> value = is_well_driven(*run) ? quantity.of(*run) : std::nullopt;
    if (!value) continue;
    spread.min = spread.count == 0 ? *value : std::min(spread.min, *value);
    spread.max = spread.count == 0 ? *value : std::max(spread.max, *value);
    spread.mean += *value;
    ++spread.count;
  }
  if (spread.count > 0) spread.mean /= static_cast<double>(spread.count);
  return spread;
}

std::string cell(const Spread& spread, int decimals) {
  if (spread.count == 0) return "-";
  const std::string mean = number(spread.mean, decimals);
  if (spread.count == 1) return mean;
  return mean + " [" + number(spread.min, decimals) + " … " + number(spread.max, decimals) + "]";
}

std::optional<double> papers_value(const Quantity& quantity, const std::string& scenario,
                                   const std::string& subgraph) {
  const auto of_scenario = quantity.paper.find(scenario);
  if (of_scenario == quantity.paper.end()) return std::nullopt;
  const auto value = of_scenario->second.find(subgraph);
  return value == of_scenario->second.end() ? std::nullopt : std::optional(value->second);
}

/// The runs of one scenario and profile, by subgraph in the order of their appearance.
struct Group {
  std::string scenario;
  std::string profile;
  std::vector<std::pair<std::string, std::vector<const RunFigures*>>> subgraphs;
};

std::vector<Group> groups_of(const std::vector<RunFigures>& runs) {
  std::vector<Group> groups;
  for (const RunFigures& run : runs) {
    auto group = std::ranges::find_if(groups, [&](const Group& one) {
      return one.scenario == run.scenario && one.profile == run.profile;
    });
    if (group == groups.end()) {
      group = groups.insert(groups.end(), {run.scenario, run.profile, {}});
    }
    auto subgraph = std::ranges::find(group->subgraphs, run.subgraph,
                                      &decltype(group->subgraphs)::value_type::first);
    if (subgraph == group->subgraphs.end()) {
      subgraph = group->subgraphs.insert(group->subgraphs.end(), {run.subgraph, {}});
    }
    subgraph->second.push_back(&run);
  }
  return groups;
}

std::string title_of(const Group& group) {
  std::string title = group.scenario + ", profile " + group.profile;
  if (group.scenario == kSimulation) title += " (the paper's simulation)";
  if (group.scenario == kLab) title += " (the paper's lab)";
  return title;
}

std::string markdown_of(const Group& group) {
  const bool has_paper = group.scenario == kSimulation || group.scenario == kLab;
  std::string text = "## " + title_of(group) + "\n\n| |";
  std::string rule = "|---|";
  for (const auto& [subgraph, runs] : group.subgraphs) {
    text += " " + subgraph + " |" + (has_paper ? " paper |" : "");
    rule += has_paper ? "---|---|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (const Quantity& quantity : quantities()) {
    text += "| " + quantity.name + " |";
    for (const auto& [subgraph, runs] : group.subgraphs) {
      text += " " + cell(spread_of(quantity, runs), quantity.decimals) + " |";
      if (!has_paper) continue;
      const std::optional<double> value = papers_value(quantity, group.scenario, subgraph);
      text += value ? " " + number(*value, std::min(quantity.decimals, 1)) + " |" : " |";
    }
    text += "\n";
  }
  text += "| Starts, good / failed |";
  for (const auto& [subgraph, runs] : group.subgraphs) {
    const auto failed =
        std::ranges::count_if(runs, [](const auto* run) { return !is_well_driven(*run); });
    text += " " + std::to_string(static_cast<std::ptrdiff_t>(runs.size()) - failed) + " / " +
            std::to_string(failed) + " |" + (has_paper ? " |" : "");
  }
  text += "\n";
  for (const auto& [subgraph, runs] : group.subgraphs) {
    for (const RunFigures* run : runs) {
      if (is_well_driven(*run)) continue;
      text += "\nFailed: subgraph " + subgraph + ", start " + std::to_string(run->start) + ": " +
              run->failure + "\n";
    }
  }
  return text + "\n";
}

}  // namespace

std::vector<PapersCell> papers_cells() {
  std::vector<PapersCell> cells;
  for (const std::string& scenario : {kSimulation, kLab}) {
    for (const std::string subgraph : {"A", "B", "C", "D"}) {
      for (const Quantity& quantity : quantities()) {
        const std::optional<double> value = papers_value(quantity, scenario, subgraph);
        if (!value || quantity.depends_on_machine) continue;
        cells.push_back({scenario, subgraph, quantity.key, *value, quantity.of});
      }
    }
  }
  return cells;
}

std::string evaluation_markdown(const std::vector<RunFigures>& runs,
                                const EvaluationOrigin& origin) {
  std::string text =
      "# Evaluation\n\nMeans over the starts, in brackets the smallest and the largest; without "
      "failed runs. Errors and lap are those of the vehicle of highest priority, the lap that of "
      "its "
      "planned positions. Computation times are processor time of the planning thread, one car's; "
      "wall times are of runs driven beside each other (`--jobs`).\n\n";
  for (const Group& group : groups_of(runs)) text += markdown_of(group);
  text += "Command: `" + origin.command + "`\n\nProgram " + origin.revision + ", compiled by " +
          origin.compiler + "; " + origin.processor + ".\n";
  return text;
}

std::string evaluation_csv(const std::vector<RunFigures>& runs) {
  std::string text = "scenario,profile,subgraph,quantity,runs,mean,min,max,paper\n";
  for (const Group& group : groups_of(runs)) {
    for (const auto& [subgraph, of_subgraph] : group.subgraphs) {
      for (const Quantity& quantity : quantities()) {
        const Spread spread = spread_of(quantity, of_subgraph);
        const std::optional<double> paper = papers_value(quantity, group.scenario, subgraph);
        text += group.scenario + "," + group.profile + "," + subgraph + "," + quantity.key + "," +
                std::to_string(spread.count);
        for (const double value : {spread.mean, spread.min, spread.max}) {
          text += "," + (spread.count > 0 ? number(value, 6) : "");
        }
        text += "," + (paper ? number(*paper, 1) : "") + "\n";
      }
    }
  }
  return text;
}

}  // namespace hlc
