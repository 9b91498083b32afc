#include "vehicle_sim/campaign/evaluation_table.hpp"

#include <algorithm>

#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/paper_table.hpp"

namespace hlc {
namespace {

/// A quantity over the starts.
struct Spread {
  std::size_t count{};
  double mean{};
  double min{};
  double max{};
};

Spread spread_of(const TableQuantity& quantity, const std::vector<const RunFigures*>& runs) {
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
  if (group.scenario == kPaperSimulation) title += " (the paper's simulation)";
  if (group.scenario == kPaperLab) title += " (the paper's lab)";
  return title;
}

std::string markdown_of(const Group& group) {
  const bool has_paper = group.scenario == kPaperSimulation || group.scenario == kPaperLab;
  std::string text = "## " + title_of(group) + "\n\n| |";
  std::string rule = "|---|";
  for (const auto& [subgraph, runs] : group.subgraphs) {
    text += " " + subgraph + " |" + (has_paper ? " paper |" : "");
    rule += has_paper ? "---|---|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (const TableQuantity& quantity : table_quantities()) {
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
      for (const TableQuantity& quantity : table_quantities()) {
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
