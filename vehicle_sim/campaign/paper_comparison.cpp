#include "vehicle_sim/campaign/paper_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/common/demand.hpp"
#include "planner/geometry/median.hpp"
#include "vehicle_sim/campaign/interval.hpp"
#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/sweep_groups.hpp"

namespace hlc::campaign {
namespace {

constexpr std::size_t kBestShown = 10;

/// sqrt(D) of single starts.
using DistanceByStart = std::map<std::size_t, double>;

bool may_be_as_near(const DistanceByStart& one, const DistanceByStart& chosen) {
  std::vector<double> differences;
  for (const auto& [start, distance] : one) differences.push_back(distance - chosen.at(start));
  const std::optional<Interval> interval = interval_of_mean(differences);
  return !interval || !interval->is_off_zero() || interval->mean < 0.0;
}

std::string factor_text(const std::optional<PaperDistance>& distance) {
  return distance ? number(distance->factor(), 3) : "-";
}

std::size_t missing_cells(const PaperDistance& distance) {
  return static_cast<std::size_t>(std::ranges::count_if(
      distance.cells, [](const ComparedCell& cell) { return !cell.ours.has_value(); }));
}

std::string best_table(const Sweep& sweep, const std::vector<JudgedCombination>& nearest) {
  std::vector<std::string> titles{""};
  for (const SweepAxis& axis : sweep.plan().axes) titles.push_back(axis.setting);
  titles.insert(titles.end(), {"factor, choosing starts", "cells missing",
                               "factor, held-out starts", "cells missing"});
  std::string text = markdown_heading(titles);
  for (std::size_t i = 0; i < std::min(kBestShown, nearest.size()); ++i) {
    const JudgedCombination& one = nearest[i];
    std::vector<std::string> cells{fmt::to_string(i + 1)};
    for (const SweepAxis& axis : sweep.plan().axes) {
      cells.push_back(
          value_of(sweep.plan(), sweep.combinations()[one.combination], axis.setting)->text);
    }
    cells.insert(cells.end(),
                 {factor_text(one.choosing),
                  fmt::format("{} of {}", missing_cells(one.choosing), one.choosing.cells.size()),
                  factor_text(one.held_out),
                  one.held_out ? fmt::to_string(missing_cells(*one.held_out)) : "-"});
    text += markdown_row(cells);
  }
  return text + "\n";
}

std::string cells_table(const JudgedCombination& chosen) {
  std::string text = markdown_heading(
      {"scenario", "subgraph", "quantity", "paper", "choosing starts", "held-out starts", "ratio"});
  const std::optional<double> none;
  for (std::size_t i = 0; i < chosen.choosing.cells.size(); ++i) {
    const ComparedCell& cell = chosen.choosing.cells[i];
    const std::optional<double>& ours = chosen.held_out ? chosen.held_out->cells[i].ours : none;
    text += markdown_row({cell.paper.scenario, cell.paper.subgraph, cell.paper.quantity,
                          number(cell.paper.value, 1), number(cell.ours, 1, "-"),
                          number(ours, 1, "-"), ours ? number(*ours / cell.paper.value, 2) : "-"});
  }
  return text + "\n";
}

std::string values_table(const Sweep& sweep, const std::vector<JudgedCombination>& nearest) {
  std::string text = markdown_heading(
      {"setting", "value", "combinations", "nearest: factor, choosing starts",
       "the same, held-out starts", "median factor, choosing starts", "may be as near"});
  for (std::size_t axis = 0; axis < sweep.plan().axes.size(); ++axis) {
    const SweepAxis& of_axis = sweep.plan().axes[axis];
    if (of_axis.values.size() > kMaxTableValues) continue;
    for (std::size_t value = 0; value < of_axis.values.size(); ++value) {
      std::vector<double> factors;
      const JudgedCombination* first = nullptr;
      std::size_t as_near = 0;
      for (const JudgedCombination& one : nearest) {
        if (sweep.combinations()[one.combination][axis] != value) continue;
        if (first == nullptr) first = &one;
        factors.push_back(one.choosing.factor());
        as_near += one.may_be_as_near ? 1U : 0U;
      }
      std::vector<std::string> cells{of_axis.setting, of_axis.values[value].text,
                                     fmt::to_string(factors.size())};
      if (first == nullptr) {
        cells.insert(cells.end(), 4, "-");
      } else {
        cells.insert(cells.end(), {factor_text(first->choosing), factor_text(first->held_out),
                                   number(median(factors), 3), fmt::to_string(as_near)});
      }
      text += markdown_row(cells);
    }
  }
  return text + "\n";
}

}  // namespace

std::vector<JudgedCombination> judged_combinations(const Sweep& sweep,
                                                   const std::vector<RunFigures>& runs) {
  HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
  const std::size_t choosing_starts = (sweep.plan().starts + 1) / 2;
  const std::vector<std::vector<std::size_t>> numbers = runs_by_combination(sweep);
  std::vector<JudgedCombination> result;
  std::vector<DistanceByStart> held_out(numbers.size());
  for (std::size_t c = 0; c < numbers.size(); ++c) {
    std::vector<RunFigures> choosing;
    std::vector<RunFigures> others;
    std::map<std::size_t, std::vector<RunFigures>> by_start;
    for (const std::size_t i : numbers[c]) {
      const std::size_t start = sweep.runs()[i].start;
      (start < choosing_starts ? choosing : others).push_back(runs[i]);
      if (start >= choosing_starts) by_start[start].push_back(runs[i]);
    }
    const std::optional<PaperDistance> distance = paper_distance(choosing);
    if (!distance) continue;
    for (const auto& [start, of_start] : by_start) {
      held_out[c][start] = std::sqrt(paper_distance(of_start).value().mean_square);
    }
    result.push_back({.combination = c,
                      .choosing = *distance,
                      .held_out = others.empty() ? std::nullopt : paper_distance(others)});
  }
  std::ranges::stable_sort(result, {},
                           [](const JudgedCombination& one) { return one.choosing.mean_square; });
  for (JudgedCombination& one : result) {
    one.may_be_as_near =
        may_be_as_near(held_out[one.combination], held_out[result.front().combination]);
  }
  return result;
}

std::string paper_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const std::vector<JudgedCombination> nearest = judged_combinations(sweep, runs);
  if (nearest.empty()) return "";
  const std::size_t starts = sweep.plan().starts;
  const std::size_t choosing = (starts + 1) / 2;
  const auto as_near = std::ranges::count_if(
      nearest, [](const JudgedCombination& one) { return one.may_be_as_near; });
  const PaperDistance& chosen = nearest.front().choosing;
  const std::optional<PaperDistance>& held_out = nearest.front().held_out;
  const std::string measured =
      held_out ? fmt::format(
                     "its distance is measured on the starts {} to {}, which had no part in "
                     "the choice",
                     choosing, starts - 1)
               : "with a single start nothing is held out to measure its distance";
  return fmt::format(
      "## Next to the paper's Table 2\n\nFactor = exp(sqrt(D)), D = mean over the cells of (ln "
      "ours / paper)², each at most (ln {:.0f})², also for cells that could not be filled; ours is "
      "the mean over the starts. By so much a typical cell is off. The nearest of {} combinations "
      "is chosen by the starts 0 to {}; {}.\n\n**The chosen combination is off by a factor of {} "
      "over the held-out starts** ({} over those that chose it).\n\n{}The chosen one's cells, the "
      "ratio that of the held-out starts:\n\n{}{} of {} combinations may be as near: the 95 % "
      "interval of the difference of sqrt(D) to the chosen one, start by start over the held-out "
      "starts, does not lie above 0. What each value of a setting allows:\n\n{}",
      kMaxCellFactor, nearest.size(), choosing - 1, measured, factor_text(held_out),
      factor_text(chosen), best_table(sweep, nearest), cells_table(nearest.front()), as_near,
      nearest.size(), values_table(sweep, nearest));
}

}  // namespace hlc::campaign
