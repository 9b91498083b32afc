#include "vehicle_sim/campaign/accuracy_comparison.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "vehicle_sim/campaign/lap_quality.hpp"
#include "vehicle_sim/campaign/number_text.hpp"

namespace hlc {
namespace {

/// The mean errors of all subgraphs with one combination in one scenario, in the plan's order.
struct Errors {
  std::size_t combination{};
  std::vector<std::optional<double>> of_subgraph_mm;
};

std::vector<Errors> errors_of(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const std::size_t subgraphs = sweep.plan().subgraphs.size();
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::vector<const RunFigures*>>> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SweepRun& what = sweep.runs()[i];
    auto& group = groups[{what.combination, what.scenario}];
    group.resize(subgraphs);
    group[what.subgraph].push_back(&runs[i]);
  }
  std::vector<Errors> all;
  for (const auto& [key, group] : groups) {
    Errors errors{.combination = key.first, .of_subgraph_mm = {}};
    for (const auto& of_subgraph : group) {
      const std::optional<LapQuality> quality = lap_quality(of_subgraph);
      errors.of_subgraph_mm.push_back(quality ? std::optional(quality->error_mean_mm)
                                              : std::nullopt);
    }
    all.push_back(errors);
  }
  return all;
}

/// "12 of 97, 0.95": the second subgraph of a pair against the first.
std::string cell(const std::vector<Errors>& all, std::size_t second) {
  std::vector<double> ratios;
  for (const Errors& one : all) {
    const auto& errors_mm = one.of_subgraph_mm;
    if (!errors_mm[second - 1] || !errors_mm[second]) continue;
    ratios.push_back(*errors_mm[second] / *errors_mm[second - 1]);
  }
  if (ratios.empty()) return "-";
  std::ranges::sort(ratios);
  const auto better = std::ranges::lower_bound(ratios, 1.0) - ratios.begin();
  return std::to_string(better) + " of " + std::to_string(ratios.size()) + ", " +
         number(ratios[ratios.size() / 2], 2);
}

std::string row(const std::string& heading, const std::vector<Errors>& errors, std::size_t pairs) {
  std::string text = "| " + heading + " |";
  for (std::size_t second = 1; second <= pairs; ++second) text += " " + cell(errors, second) + " |";
  return text + "\n";
}

}  // namespace

std::string accuracy_comparison(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const SweepPlan& plan = sweep.plan();
  if (plan.subgraphs.size() < 2) return "";
  const std::size_t pairs = plan.subgraphs.size() - 1;
  const std::vector<Errors> all = errors_of(sweep, runs);
  std::string text =
      "## Which subgraph is more accurate\n\nOf the combinations with which both drive a lap from "
      "every start, in how many the second subgraph has the smaller mean error, and the median of "
      "the second's error / the first's.\n\n| setting | value |";
  std::string rule = "|---|---|";
  for (std::size_t second = 1; second <= pairs; ++second) {
    text += " " + plan.subgraphs[second] + " against " + plan.subgraphs[second - 1] + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n" + row("all | ", all, pairs);
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
    const SweepAxis& of_axis = plan.axes[axis];
    for (std::size_t value = 0; value < of_axis.values.size(); ++value) {
      std::vector<Errors> with_value;
      std::ranges::copy_if(all, std::back_inserter(with_value), [&](const Errors& one) {
        return sweep.combinations()[one.combination][axis] == value;
      });
      text += row(of_axis.setting + " | " + of_axis.values[value].text, with_value, pairs);
    }
  }
  return text + "\n";
}

}  // namespace hlc
