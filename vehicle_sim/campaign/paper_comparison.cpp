#include "vehicle_sim/campaign/paper_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/common/demand.hpp"
#include "planner/geometry/median.hpp"
#include "vehicle_sim/campaign/interval.hpp"
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
  std::string text = "| |";
  std::string rule = "|---|";
  for (const SweepAxis& axis : sweep.plan().axes) {
    text += " " + axis.setting + " |";
    rule += "---|";
  }
  text += " factor, choosing starts | cells missing | factor, held-out starts | cells missing |\n" +
          rule + "---|---|---|---|\n";
  for (std::size_t i = 0; i < std::min(kBestShown, nearest.size()); ++i) {
    const JudgedCombination& one = nearest[i];
    text += "| " + std::to_string(i + 1) + " |";
    for (const SweepAxis& axis : sweep.plan().axes) {
      text += " " +
              value_of(sweep.plan(), sweep.combinations()[one.combination], axis.setting)->text +
              " |";
    }
    text += " " + factor_text(one.choosing) + " | " + std::to_string(missing_cells(one.choosing)) +
            " of " + std::to_string(one.choosing.cells.size()) + " | " + factor_text(one.held_out) +
            " | " + (one.held_out ? std::to_string(missing_cells(*one.held_out)) : "-") + " |\n";
  }
  return text + "\n";
}

std::string cells_table(const JudgedCombination& chosen) {
  std::string text =
      "| scenario | subgraph | quantity | paper | choosing starts | held-out starts | ratio |\n"
      "|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < chosen.choosing.cells.size(); ++i) {
    const ComparedCell& cell = chosen.choosing.cells[i];
    const std::optional<double> ours =
        chosen.held_out ? chosen.held_out->cells[i].ours : std::nullopt;
    text += "| " + cell.paper.scenario + " | " + cell.paper.subgraph + " | " + cell.paper.quantity +
            " | " + number(cell.paper.value, 1) + " | " +
            (cell.ours ? number(*cell.ours, 1) : "-") + " | " + (ours ? number(*ours, 1) : "-") +
            " | " + (ours ? number(*ours / cell.paper.value, 2) : "-") + " |\n";
  }
  return text + "\n";
}

std::string values_table(const Sweep& sweep, const std::vector<JudgedCombination>& nearest) {
  std::string text =
      "| setting | value | combinations | nearest: factor, choosing starts | the same, held-out "
      "starts | median factor, choosing starts | may be as near |\n|---|---|---|---|---|---|---|\n";
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
      text += "| " + of_axis.setting + " | " + of_axis.values[value].text + " | " +
              std::to_string(factors.size()) + " | ";
      if (first == nullptr) {
        text += "- | - | - | - |\n";
        continue;
      }
      text += factor_text(first->choosing) + " | " + factor_text(first->held_out) + " | " +
              number(median(factors), 3) + " | " + std::to_string(as_near) + " |\n";
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
  return "## Next to the paper's Table 2\n\nFactor = exp(sqrt(D)), D = mean over the cells of (ln "
         "ours / paper)², each at most (ln " +
         number(kMaxCellFactor, 0) +
         ")², also for cells that could not be filled; ours is the mean over the starts. By so "
         "much a typical cell is off. The nearest of " +
         std::to_string(nearest.size()) + " combinations is chosen by the starts 0 to " +
         std::to_string(choosing - 1) +
         (held_out
              ? "; its distance is measured on the starts " + std::to_string(choosing) + " to " +
                    std::to_string(starts - 1) + ", which had no part in the choice.\n\n"
              : "; with a single start nothing is held out to measure its distance.\n\n") +
         "**The chosen combination is off by a factor of " + factor_text(held_out) +
         " over the held-out starts** (" + factor_text(chosen) + " over those that chose it).\n\n" +
         best_table(sweep, nearest) +
         "The chosen one's cells, the ratio that of the held-out "
         "starts:\n\n" +
         cells_table(nearest.front()) + std::to_string(as_near) + " of " +
         std::to_string(nearest.size()) +
         " combinations may be as near: the 95 % interval of the difference of sqrt(D) to the "
         "chosen one, start by start over the held-out starts, does not lie above 0. What each "
         "value of a setting allows:\n\n" +
         values_table(sweep, nearest);
}

}  // namespace hlc::campaign
