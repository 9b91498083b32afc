#include "vehicle_sim/campaign/evaluation_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/common/csv.hpp"
#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/paper_table.hpp"

namespace hlc::campaign {
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
  return fmt::format("{} [{:.{}f} … {:.{}f}]", mean, spread.min, decimals, spread.max, decimals);
}

/// The runs on one subgraph, or with one policy.
struct Column {
  std::string name;
  std::vector<const RunFigures*> runs;

  [[nodiscard]] const RunFigures& first() const { return *runs.front(); }
  /// None for a policy: the paper has no policies.
  [[nodiscard]] std::optional<double> papers(const TableQuantity& quantity) const {
    if (has_policy(first())) return std::nullopt;
    return papers_value(quantity, first().scenario, first().subgraph);
  }
};

/// The runs of one scenario and profile, in the order of their appearance.
struct Group {
  std::string scenario;
  std::string profile;
  std::vector<Column> columns;
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
    auto column = std::ranges::find_if(group->columns, [&](const Column& one) {
      return one.first().subgraph == run.subgraph && one.first().policy == run.policy;
    });
    if (column == group->columns.end()) {
      column = group->columns.insert(group->columns.end(), {planned_on(run), {}});
    }
    column->runs.push_back(&run);
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
  std::vector<std::string> titles{""};
  for (const Column& column : group.columns) {
    titles.push_back(column.name);
    if (has_paper) titles.emplace_back("paper");
  }
  std::string text = "## " + title_of(group) + "\n\n" + markdown_heading(titles);
  for (const TableQuantity& quantity : table_quantities()) {
    std::vector<std::string> cells{quantity.name};
    for (const Column& column : group.columns) {
      cells.push_back(cell(spread_of(quantity, column.runs), quantity.decimals));
      if (!has_paper) continue;
      cells.push_back(number(column.papers(quantity), std::min(quantity.decimals, 1), ""));
    }
    text += markdown_row(cells);
  }
  std::vector<std::string> starts{"Starts, good / failed"};
  for (const Column& column : group.columns) {
    const auto good = std::ranges::count_if(
        column.runs, [](const RunFigures* run) { return is_well_driven(*run); });
    starts.push_back(fmt::format("{} / {}", good, std::ssize(column.runs) - good));
    if (has_paper) starts.emplace_back();
  }
  text += markdown_row(starts);
  for (const Column& column : group.columns) {
    for (const RunFigures* run : column.runs) {
      if (is_well_driven(*run)) continue;
      text += fmt::format("\nFailed: {}{}, start {}: {}\n", has_policy(*run) ? "" : "subgraph ",
                          column.name, run->start, run->failure);
    }
  }
  return text + "\n";
}

}  // namespace

std::string origin_text(const EvaluationOrigin& origin) {
  return fmt::format("Command: `{}`\n\nProgram {}, compiled by {}; {}.\n", origin.command,
                     origin.revision, origin.compiler, origin.processor);
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
  return text + origin_text(origin);
}

std::string evaluation_csv(const std::vector<RunFigures>& runs) {
  std::string text = "scenario,profile,subgraph,policy,quantity,runs,mean,min,max,paper\n";
  for (const Group& group : groups_of(runs)) {
    for (const Column& column : group.columns) {
      for (const TableQuantity& quantity : table_quantities()) {
        const Spread spread = spread_of(quantity, column.runs);
        const std::optional<double> paper = column.papers(quantity);
        CsvLine line(group.scenario, group.profile, column.first().subgraph, column.first().policy,
                     quantity.key, spread.count);
        for (const double value : {spread.mean, spread.min, spread.max}) {
          line.add(spread.count > 0 ? number(value, 6) : "");
        }
        line.add(number(paper, 1, ""));
        text += line.text();
      }
    }
  }
  return text;
}

}  // namespace hlc::campaign
