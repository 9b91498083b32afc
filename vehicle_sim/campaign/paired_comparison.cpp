#include "vehicle_sim/campaign/paired_comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "planner/common/demand.hpp"
#include "vehicle_sim/campaign/interval.hpp"
#include "vehicle_sim/campaign/paper_distance.hpp"
#include "vehicle_sim/campaign/sweep_groups.hpp"

namespace hlc::campaign {
namespace {

/// Second minus first of the pairs with one subgraph.
struct PairedRuns {
  std::size_t pairs{};
  std::size_t laps_of_first{};
  std::size_t laps_of_second{};
  ValuesByStart error_mm;
  ValuesByStart lap_s;
  ValuesByStart generated;

  void add(std::size_t start, const RunFigures& first, const RunFigures& second) {
    ++pairs;
    laps_of_first += has_lap(first) ? 1U : 0U;
    laps_of_second += has_lap(second) ? 1U : 0U;
    if (!has_lap(first) || !has_lap(second)) return;
    error_mm[start].push_back(*second.error_mean_mm - *first.error_mean_mm);
    lap_s[start].push_back(*second.lap_s - *first.lap_s);
    generated[start].push_back(second.generated_max - first.generated_max);
  }
};

/// The interval of a mean of logarithms, as the corresponding ratio.
std::string ratio_in_words(const std::optional<Interval>& logs) {
  if (!logs) return "-";
  const double mean = std::exp(logs->mean);
  if (!logs->half_width) return fmt::format("{:.3f}", mean);
  return fmt::format("{:.3f} [{:.3f} … {:.3f}]", mean, std::exp(logs->mean - *logs->half_width),
                     std::exp(logs->mean + *logs->half_width));
}

class Pairs {
 public:
  Pairs(const Sweep& sweep, const std::vector<RunFigures>& runs)
      : sweep_(sweep), runs_(runs), numbers_(runs_by_combination(sweep)) {
    HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
    for (std::size_t c = 0; c < sweep.combinations().size(); ++c) {
      by_values_[sweep.combinations()[c]] = c;
    }
  }

  /// @param within  the pairs' combinations are of this group
  void write_rows(std::size_t axis, std::size_t value, const SweepGroup& within) {
    const SweepPlan& plan = sweep_.plan();
    BySubgraph by_subgraph;
    ValuesByStart logs;
    for (const std::size_t second : within.combinations) {
      if (sweep_.combinations()[second][axis] != value) continue;
      SweepCombination partner = sweep_.combinations()[second];
      partner[axis] = 0;
      const auto first = by_values_.find(partner);
      if (first == by_values_.end()) continue;  // not in the sample
      add(first->second, second, by_subgraph, logs);
    }
    const SweepAxis& of_axis = plan.axes[axis];
    const std::string heading =
        fmt::format("| {} | {} | {} | {} | ", of_axis.setting, of_axis.values[value].text,
                    of_axis.values[0].text, values_text(within));
    for (const auto& [key, paired] : by_subgraph) {
      const auto [scenario, subgraph] = key;
      rows_ += fmt::format("{}{}, {} | {} | {}, {} | {} | {} | {} |\n", heading,
                           plan.scenarios[scenario].stem().string(), plan.subgraphs[subgraph],
                           paired.pairs, paired.laps_of_second, paired.laps_of_first,
                           in_words(interval_over_starts(paired.error_mm), 2),
                           in_words(interval_over_starts(paired.lap_s), 3),
                           in_words(interval_over_starts(paired.generated), 0));
    }
    if (!logs.empty()) {
      distance_rows_ += heading + ratio_in_words(interval_over_starts(logs)) + " |\n";
    }
  }

  [[nodiscard]] std::string markdown() const {
    if (rows_.empty()) return "";
    std::string text =
        "## What a setting does, pair by pair\n\nEach value against the setting's first one, in "
        "pairs of runs from the same start with all else equal: means of the differences, of the "
        "pairs in which both drove a lap, with 95 % intervals, where each start counts once.\n\n"
        "| setting | value | against | with | scenario, subgraph | pairs | laps of both | error "
        "[mm] | lap [s] | max. generated |\n|---|---|---|---|---|---|---|---|---|---|\n" +
        rows_ + "\n";
    if (distance_rows_.empty()) return text;
    return text +
           "The same of the factors by which the runs of one start are off the paper's Table 2, as "
           "their ratio: below 1, the value comes nearer.\n\n| setting | value | against | with | "
           "factor, ratio |\n|---|---|---|---|---|\n" +
           distance_rows_ + "\n";
  }

 private:
  using BySubgraph = std::map<std::pair<std::size_t, std::size_t>, PairedRuns>;

  void add(std::size_t first, std::size_t second, BySubgraph& by_subgraph,
           ValuesByStart& logs) const {
    std::map<std::size_t, std::pair<std::vector<RunFigures>, std::vector<RunFigures>>> by_start;
    // Combinations have the same runs in the same order.
    for (std::size_t k = 0; k < numbers_[second].size(); ++k) {
      const RunFigures& a = runs_[numbers_[first][k]];
      const RunFigures& b = runs_[numbers_[second][k]];
      const SweepRun& what = sweep_.runs()[numbers_[second][k]];
      by_subgraph[{what.scenario, what.subgraph}].add(what.start, a, b);
      by_start[what.start].first.push_back(a);
      by_start[what.start].second.push_back(b);
    }
    for (const auto& [start, both] : by_start) {
      const std::optional<PaperDistance> a = paper_distance(both.first);
      const std::optional<PaperDistance> b = paper_distance(both.second);
      if (a && b) logs[start].push_back(std::sqrt(b->mean_square) - std::sqrt(a->mean_square));
    }
  }

  const Sweep& sweep_;
  const std::vector<RunFigures>& runs_;
  std::vector<std::vector<std::size_t>> numbers_;
  std::map<SweepCombination, std::size_t> by_values_;
  std::string rows_;
  std::string distance_rows_;
};

}  // namespace

std::string paired_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  Pairs pairs(sweep, runs);
  for (Axes others : groupings_of(sweep.plan())) {
    if (others.empty()) continue;
    const std::size_t axis = others.back();
    others.pop_back();
    for (const SweepGroup& within : groups_of(sweep, others)) {
      for (std::size_t value = 1; value < sweep.plan().axes[axis].values.size(); ++value) {
        pairs.write_rows(axis, value, within);
      }
    }
  }
  return pairs.markdown();
}

}  // namespace hlc::campaign
