#include "vehicle_sim/campaign/accuracy_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/geometry/median.hpp"
#include "vehicle_sim/campaign/interval.hpp"
#include "vehicle_sim/campaign/lap_quality.hpp"
#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/sweep_groups.hpp"

namespace hlc::campaign {
namespace {

/// The runs of one combination in one scenario: by subgraph in the plan's order, then start.
using RunsBySubgraph = std::vector<std::vector<const RunFigures*>>;

class Comparison {
 public:
  Comparison(const Sweep& sweep, const std::vector<RunFigures>& runs)
      : by_combination_(
            sweep.combinations().size(),
            std::vector<RunsBySubgraph>(sweep.plan().scenarios.size(),
                                        RunsBySubgraph(sweep.plan().subgraphs.size()))) {
    HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const SweepRun& what = sweep.runs()[i];
      by_combination_[what.combination][what.scenario][what.subgraph].push_back(&runs[i]);
    }
  }

  /// "12 of 97, 0.95; -1.20 ± 0.30 mm": subgraph number `second` against the one before.
  [[nodiscard]] std::string cell(const SweepGroup& group, std::size_t second) const {
    std::vector<double> ratios;
    ValuesByStart differences_mm;
    for (const std::size_t combination : group.combinations) {
      for (const RunsBySubgraph& runs : by_combination_[combination]) {
        const std::optional<LapQuality> a = lap_quality(runs[second - 1]);
        const std::optional<LapQuality> b = lap_quality(runs[second]);
        if (a && b) ratios.push_back(b->error_mean_mm / a->error_mean_mm);
        for (std::size_t start = 0; start < runs[second].size(); ++start) {
          const RunFigures& one = *runs[second - 1][start];
          const RunFigures& other = *runs[second][start];
          if (!has_lap(one) || !has_lap(other)) continue;
          differences_mm[other.start].push_back(*other.error_mean_mm - *one.error_mean_mm);
        }
      }
    }
    if (ratios.empty() && differences_mm.empty()) return "-";
    const auto better = std::ranges::count_if(ratios, [](double ratio) { return ratio < 1.0; });
    std::string text = fmt::format("{} of {}", better, ratios.size());
    if (!ratios.empty()) text += fmt::format(", {:.2f}", median(std::move(ratios)));
    return text + "; " + in_words(interval_over_starts(differences_mm), 2) + " mm";
  }

 private:
  std::vector<std::vector<RunsBySubgraph>> by_combination_;  ///< then by scenario
};

}  // namespace

std::string accuracy_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const SweepPlan& plan = sweep.plan();
  const std::size_t subgraphs = plan.subgraphs.size();
  if (subgraphs < 2) return "";
  const Comparison comparison(sweep, runs);
  std::string text =
      "## Which subgraph is more accurate\n\nOf the combinations with which both drive a lap from "
      "every start, in how many the second subgraph has the smaller mean error, and the median of "
      "the second's error / the first's; then the difference second - first, start by start with "
      "all else equal, where both drive a lap, with the 95 % interval of its mean, where each "
      "start counts once.\n\n";
  std::vector<std::string> titles{"setting", "value"};
  for (std::size_t second = 1; second < subgraphs; ++second) {
    titles.push_back(plan.subgraphs[second] + " against " + plan.subgraphs[second - 1]);
  }
  text += markdown_heading(titles);
  for (const Axes& axes : groupings_of(plan)) {
    for (const SweepGroup& group : groups_of(sweep, axes)) {
      std::vector<std::string> cells{settings_text(plan, axes), values_text(group)};
      for (std::size_t second = 1; second < subgraphs; ++second) {
        cells.push_back(comparison.cell(group, second));
      }
      text += fmt::format("| {} |\n", fmt::join(cells, " | "));
    }
  }
  return text + "\n";
}

}  // namespace hlc::campaign
