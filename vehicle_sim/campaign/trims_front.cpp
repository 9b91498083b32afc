#include "vehicle_sim/campaign/trims_front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "planner/common/demand.hpp"
#include "vehicle_sim/campaign/lap_quality.hpp"
#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"

namespace hlc::campaign {
namespace {

const std::vector<TrimId>& trims_of(const Sweep& sweep, std::size_t combination) {
  const SweepValue* trims =
      value_of(sweep.plan(), sweep.combinations()[combination], kTrimsSetting);
  HLC_DEMAND(trims != nullptr);
  return trims->trims;
}

/// The settings of a combination as text, trims first.
std::string name_of(const Sweep& sweep, std::size_t combination) {
  const SweepCombination& values = sweep.combinations()[combination];
  std::string name = value_of(sweep.plan(), values, kTrimsSetting)->text;
  for (const SweepAxis& axis : sweep.plan().axes) {
    if (axis.setting == kTrimsSetting || axis.values.size() == 1) continue;
    name += ", " + axis.setting + " " + value_of(sweep.plan(), values, axis.setting)->text;
  }
  return name;
}

std::string row(const Sweep& sweep, const TrimsQuality& choice, const std::string& note) {
  return markdown_row({fmt::to_string(choice.moving), name_of(sweep, choice.combination),
                       number(choice.error_mean_mm, 2), number(choice.lap_s, 2),
                       number(choice.generated_max, 0), note});
}

bool dominates(const TrimsQuality& a, const TrimsQuality& b) {
  return a.moving <= b.moving && a.error_mean_mm <= b.error_mean_mm &&
         (a.moving < b.moving || a.error_mean_mm < b.error_mean_mm);
}

/// Number of choices with these trims that are better.
std::string place_of(const std::vector<TrimsQuality>& choices, const TrimsQuality& choice) {
  const auto better = std::ranges::count_if(
      choices, [&](const TrimsQuality& one) { return dominates(one, choice); });
  const auto same_size = std::ranges::count_if(
      choices, [&](const TrimsQuality& one) { return one.moving == choice.moving; });
  const auto ahead = std::ranges::count_if(choices, [&](const TrimsQuality& one) {
    return one.moving == choice.moving && one.error_mean_mm < choice.error_mean_mm;
  });
  return fmt::format("{}; number {} of {} with as many trims",
                     better == 0 ? "on the front" : fmt::format("{} choices dominate it", better),
                     ahead + 1, same_size);
}

std::string markdown_of(const Sweep& sweep, const std::vector<TrimsQuality>& choices) {
  std::string text = markdown_heading(
      {"moving trims", "trims", "error, mean [mm]", "lap [s]", "max. generated", ""});
  for (const TrimsQuality& choice : trims_front(choices)) text += row(sweep, choice, "front");
  const std::size_t most = std::ranges::max_element(choices, {}, &TrimsQuality::moving)->moving;
  // Sorted: the first with so many is the most accurate of them.
  const TrimsQuality& all = *std::ranges::find(choices, most, &TrimsQuality::moving);
  const TrimsQuality& smallest = *std::ranges::find_if(
      choices, [&](const TrimsQuality& one) { return one.error_mean_mm <= all.error_mean_mm; });
  text += row(sweep, smallest, "smallest, not less accurate than the largest");
  for (const automaton::SubgraphSpec& spec : sweep.offered_subgraphs()) {
    std::vector<TrimId> trims = spec.trims;
    std::ranges::sort(trims);
    for (const TrimsQuality& choice : choices) {
      if (trims_of(sweep, choice.combination) != trims) continue;
      text += row(sweep, choice, "trims of " + spec.name + ": " + place_of(choices, choice));
    }
  }
  return text + "\n";
}

}  // namespace

std::vector<TrimsQuality> trims_that_drive(const Sweep& sweep, const std::vector<RunFigures>& runs,
                                           std::size_t scenario, std::size_t subgraph) {
  HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
  std::vector<std::vector<const RunFigures*>> by_combination(sweep.combinations().size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SweepRun& run = sweep.runs()[i];
    if (run.scenario != scenario || run.subgraph != subgraph) continue;
    by_combination[run.combination].push_back(&runs[i]);
  }
  std::vector<TrimsQuality> choices;
  for (std::size_t c = 0; c < by_combination.size(); ++c) {
    const std::optional<LapQuality> quality = lap_quality(by_combination[c]);
    if (!quality) continue;
    const auto moving = std::ranges::count_if(trims_of(sweep, c),
                                              [&](TrimId trim) { return sweep.is_moving(trim); });
    choices.push_back({.combination = c,
                       .moving = static_cast<std::size_t>(moving),
                       .error_mean_mm = quality->error_mean_mm,
                       .lap_s = quality->lap_s,
                       .generated_max = quality->generated_max});
  }
  std::ranges::stable_sort(choices, {}, [](const TrimsQuality& one) {
    return std::tuple(one.moving, one.error_mean_mm);
  });
  return choices;
}

std::vector<TrimsQuality> trims_front(const std::vector<TrimsQuality>& choices) {
  std::vector<TrimsQuality> front;
  std::ranges::copy_if(choices, std::back_inserter(front), [&](const TrimsQuality& one) {
    return std::ranges::none_of(choices,
                                [&](const TrimsQuality& other) { return dominates(other, one); });
  });
  return front;
}

std::string trims_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  std::string text;
  for (std::size_t scenario = 0; scenario < sweep.plan().scenarios.size(); ++scenario) {
    for (std::size_t subgraph = 0; subgraph < sweep.plan().subgraphs.size(); ++subgraph) {
      const std::vector<TrimsQuality> choices = trims_that_drive(sweep, runs, scenario, subgraph);
      text += fmt::format(
          "## Trims: {}, maneuvers of {}\n\n{} of {} choices drive a lap from every start.\n\n",
          sweep.plan().scenarios[scenario].stem().string(), sweep.plan().subgraphs[subgraph],
          choices.size(), sweep.combinations().size());
      if (!choices.empty()) text += markdown_of(sweep, choices);
    }
  }
  return text;
}

}  // namespace hlc::campaign
