#include "vehicle_sim/campaign/sweep_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "planner/common/csv.hpp"
#include "planner/common/demand.hpp"
#include "vehicle_sim/campaign/interval.hpp"
#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/sweep_groups.hpp"

namespace hlc::campaign {
namespace {

struct SweepQuantity {
  const char* title;
  const char* key;
  int decimals;
  std::optional<double> (*of)(const RunFigures&);
};

constexpr std::array kSweepQuantities{
    SweepQuantity{"error, planned [mm]", "error_mean_mm", 1,
                  [](const RunFigures& run) { return run.error_mean_mm; }},
    SweepQuantity{"error, driven [mm]", "driven_error_mean_mm", 1,
                  [](const RunFigures& run) { return run.driven_error_mean_mm; }},
    SweepQuantity{"lap [s]", "lap_s", 2, [](const RunFigures& run) { return run.lap_s; }},
    SweepQuantity{"max. generated", "generated_max", 0,
                  [](const RunFigures& run) { return std::optional(run.generated_max); }}};

/// One row: a group's runs in one scenario with one subgraph.
struct TableRow {
  std::size_t runs{};
  std::size_t laps{};
  std::array<ValuesByStart, kSweepQuantities.size()> values;
};

class Tables {
 public:
  Tables(const Sweep& sweep, const std::vector<RunFigures>& runs)
      : sweep_(sweep), runs_(runs), numbers_(runs_by_combination(sweep)) {
    HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
  }

  [[nodiscard]] TableRow row(const SweepGroup& group, std::size_t scenario,
                             std::size_t subgraph) const {
    TableRow row;
    for (const std::size_t combination : group.combinations) {
      for (const std::size_t i : numbers_[combination]) {
        const SweepRun& what = sweep_.runs()[i];
        if (what.scenario != scenario || what.subgraph != subgraph) continue;
        ++row.runs;
        if (!has_lap(runs_[i])) continue;
        ++row.laps;
        for (std::size_t q = 0; q < kSweepQuantities.size(); ++q) {
          const std::optional<double> value = kSweepQuantities[q].of(runs_[i]);
          if (value) row.values[q][what.start].push_back(*value);
        }
      }
    }
    return row;
  }

  [[nodiscard]] std::string markdown(std::size_t scenario, const Axes& axes) const {
    const SweepPlan& plan = sweep_.plan();
    std::vector<std::string> titles;
    for (const std::size_t axis : axes) titles.push_back(plan.axes[axis].setting);
    titles.insert(titles.end(), {"subgraph", "combinations", "laps"});
    for (const SweepQuantity& quantity : kSweepQuantities) titles.emplace_back(quantity.title);
    std::string text = markdown_heading(titles);
    for (const SweepGroup& group : groups_of(sweep_, axes)) {
      for (std::size_t s = 0; s < plan.subgraphs.size(); ++s) {
        const TableRow found = row(group, scenario, s);
        std::vector<std::string> cells = group.values;
        cells.insert(cells.end(), {plan.subgraphs[s], fmt::to_string(group.combinations.size()),
                                   fmt::format("{} of {}", found.laps, found.runs)});
        for (std::size_t q = 0; q < kSweepQuantities.size(); ++q) {
          cells.push_back(
              in_words(interval_over_starts(found.values[q]), kSweepQuantities[q].decimals));
        }
        text += markdown_row(cells);
      }
    }
    return text + "\n";
  }

  [[nodiscard]] std::string csv(std::size_t scenario, const Axes& axes) const {
    const SweepPlan& plan = sweep_.plan();
    std::string text;
    for (const SweepGroup& group : groups_of(sweep_, axes)) {
      const CsvLine heading(plan.scenarios[scenario].stem().string(),
                            settings_text(plan, axes, "; "), values_text(group, "; "));
      for (std::size_t s = 0; s < plan.subgraphs.size(); ++s) {
        const TableRow cells = row(group, scenario, s);
        for (std::size_t q = 0; q < kSweepQuantities.size(); ++q) {
          const std::optional<Interval> interval = interval_over_starts(cells.values[q]);
          CsvLine line = heading;
          line.add(plan.subgraphs[s], group.combinations.size(), cells.runs, cells.laps,
                   kSweepQuantities[q].key, interval ? number(interval->mean, 6) : "",
                   interval ? number(interval->half_width, 6, "") : "");
          text += line.text();
        }
      }
    }
    return text;
  }

 private:
  const Sweep& sweep_;
  const std::vector<RunFigures>& runs_;
  std::vector<std::vector<std::size_t>> numbers_;
};

}  // namespace

std::string sweep_tables_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const Tables tables(sweep, runs);
  const SweepPlan& plan = sweep.plan();
  std::string text =
      "## Results by setting\n\nOf the runs with a lap; ± is the 95 % interval of the mean, where "
      "each start counts once, as the mean over its combinations.\n\n";
  for (std::size_t scenario = 0; scenario < plan.scenarios.size(); ++scenario) {
    for (const Axes& axes : groupings_of(plan)) {
      text += fmt::format("### {}, by {}\n\n{}", plan.scenarios[scenario].stem().string(),
                          settings_text(plan, axes), tables.markdown(scenario, axes));
    }
  }
  return text;
}

std::string sweep_tables_csv(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const Tables tables(sweep, runs);
  std::string text =
      "scenario,settings,values,subgraph,combinations,runs,laps,quantity,mean,half_width\n";
  for (std::size_t scenario = 0; scenario < sweep.plan().scenarios.size(); ++scenario) {
    for (const Axes& axes : groupings_of(sweep.plan())) text += tables.csv(scenario, axes);
  }
  return text;
}

}  // namespace hlc::campaign
