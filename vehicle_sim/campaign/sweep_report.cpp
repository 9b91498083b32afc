#include "vehicle_sim/campaign/sweep_report.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <regex>

#include "vehicle_sim/campaign/accuracy_comparison.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/paper_distance.hpp"
#include "vehicle_sim/campaign/trims_front.hpp"

namespace hlc {
namespace {

constexpr std::size_t kBestShown = 10;
constexpr std::size_t kReasonsShown = 20;

std::string number_or_empty(const std::optional<double>& value, int decimals) {
  return value ? number(*value, decimals) : "";
}

std::string as_factor(double mean_square) { return number(std::exp(std::sqrt(mean_square)), 3); }

/// A combination beside the paper.
struct Judged {
  std::size_t combination{};
  PaperDistance distance;  ///< over all starts
  double least{};          ///< D of one start
  double largest{};
};

/// Those that the paper has cells for, nearest first.
std::vector<Judged> judged(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  std::vector<std::map<std::size_t, std::vector<RunFigures>>> by_start(sweep.combinations().size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    by_start[sweep.runs()[i].combination][sweep.runs()[i].start].push_back(runs[i]);
  }
  std::vector<Judged> result;
  for (std::size_t c = 0; c < by_start.size(); ++c) {
    std::vector<RunFigures> all;
    std::vector<double> of_starts;
    for (const auto& [start, of_start] : by_start[c]) {
      all.insert(all.end(), of_start.begin(), of_start.end());
      const std::optional<PaperDistance> distance = paper_distance(of_start);
      if (distance) of_starts.push_back(distance->mean_square);
    }
    std::optional<PaperDistance> distance = paper_distance(all);
    if (!distance) continue;
    result.push_back({c, std::move(*distance), *std::ranges::min_element(of_starts),
                      *std::ranges::max_element(of_starts)});
  }
  std::ranges::stable_sort(result, {}, [](const Judged& one) { return one.distance.mean_square; });
  return result;
}

std::string best_table(const Sweep& sweep, const std::vector<Judged>& nearest) {
  std::string text = "| |";
  std::string rule = "|---|";
  for (const SweepAxis& axis : sweep.plan().axes) {
    text += " " + axis.setting + " |";
    rule += "---|";
  }
  text += " D | one start | factor | cells missing |\n" + rule + "---|---|---|---|\n";
  for (std::size_t i = 0; i < std::min(kBestShown, nearest.size()); ++i) {
    const Judged& one = nearest[i];
    text += "| " + std::to_string(i + 1) + " |";
    for (const SweepAxis& axis : sweep.plan().axes) {
      text += " " +
              value_of(sweep.plan(), sweep.combinations()[one.combination], axis.setting)->text +
              " |";
    }
    const auto missing = std::ranges::count_if(
        one.distance.cells, [](const ComparedCell& cell) { return !cell.ours.has_value(); });
    text += " " + number(one.distance.mean_square, 4) + " | " + number(one.least, 4) + " … " +
            number(one.largest, 4) + " | " + number(one.distance.factor(), 3) + " | " +
            std::to_string(missing) + " of " + std::to_string(one.distance.cells.size()) + " |\n";
  }
  return text + "\n";
}

std::string cells_table(const PaperDistance& distance) {
  std::string text =
      "| scenario | subgraph | quantity | paper | best | ratio |\n|---|---|---|---|---|---|\n";
  for (const ComparedCell& cell : distance.cells) {
    text += "| " + cell.paper.scenario + " | " + cell.paper.subgraph + " | " + cell.paper.quantity +
            " | " + number(cell.paper.value, 1) + " | " +
            (cell.ours ? number(*cell.ours, 1) : "-") + " | " +
            (cell.ours ? number(*cell.ours / cell.paper.value, 2) : "-") + " |\n";
  }
  return text + "\n";
}

std::string values_table(const Sweep& sweep, const std::vector<Judged>& nearest) {
  const double as_good = nearest.front().largest;
  std::string text =
      "| setting | value | combinations | best factor | median factor | as good as the best |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t axis = 0; axis < sweep.plan().axes.size(); ++axis) {
    const SweepAxis& of_axis = sweep.plan().axes[axis];
    if (of_axis.setting == kTrimsSetting) continue;  // too many: they have their own part
    for (std::size_t value = 0; value < of_axis.values.size(); ++value) {
      std::vector<double> distances;  // ascending, as `nearest`
      for (const Judged& one : nearest) {
        if (sweep.combinations()[one.combination][axis] != value) continue;
        distances.push_back(one.distance.mean_square);
      }
      text += "| " + of_axis.setting + " | " + of_axis.values[value].text + " | " +
              std::to_string(distances.size()) + " | ";
      if (distances.empty()) {
        text += "- | - | - |\n";
        continue;
      }
      text += as_factor(distances.front()) + " | " + as_factor(distances[distances.size() / 2]) +
              " | " +
              std::to_string(std::ranges::upper_bound(distances, as_good) - distances.begin()) +
              " |\n";
    }
  }
  return text + "\n";
}

std::string paper_part(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  const std::vector<Judged> nearest = judged(sweep, runs);
  if (nearest.empty()) return "";
  const auto as_good = std::ranges::count_if(nearest, [&](const Judged& one) {
    return one.distance.mean_square <= nearest.front().largest;
  });
  return "## Next to the paper's Table 2\n\nD = mean over the cells of (ln ours / paper)², each at "
         "most (ln " +
         number(kMaxCellFactor, 0) +
         ")², also for cells that could not be filled; ours is the mean over the starts. Factor = "
         "exp(sqrt(D)): by so much a typical cell is off. One start: the smallest and largest D of "
         "a single start.\n\n" +
         best_table(sweep, nearest) + "The best one's cells:\n\n" +
         cells_table(nearest.front().distance) + std::to_string(as_good) + " of " +
         std::to_string(nearest.size()) +
         " combinations are as good as the best: their D is not above its largest D of one "
         "start. What each value of a setting allows:\n\n" +
         values_table(sweep, nearest);
}

/// A reason with its numbers taken out: "vehicle # was out of its areas in # steps".
struct Reason {
  std::string text;
  std::vector<std::string> numbers;
};

constexpr char kNumberHere = '#';

Reason reason_of(const std::string& failure) {
  static const std::regex number_text("[0-9]+([.][0-9]+)?");
  Reason reason;
  for (std::sregex_iterator it(failure.begin(), failure.end(), number_text), end; it != end; ++it) {
    reason.numbers.push_back(it->str());
  }
  reason.text = std::regex_replace(failure, number_text, std::string(1, kNumberHere));
  return reason;
}

/// The runs that failed for the same reason.
struct Failures {
  std::size_t count{};
  std::vector<std::string> least;  ///< of the reason's numbers
  std::vector<std::string> largest;

  void add(const std::vector<std::string>& numbers) {
    if (count++ == 0) least = largest = numbers;
    for (std::size_t i = 0; i < std::min(numbers.size(), least.size()); ++i) {
      if (std::stod(numbers[i]) < std::stod(least[i])) least[i] = numbers[i];
      if (std::stod(numbers[i]) > std::stod(largest[i])) largest[i] = numbers[i];
    }
  }

  [[nodiscard]] std::string in_words(const std::string& reason) const {
    std::string text;
    std::size_t number = 0;
    for (const char letter : reason) {
      if (letter != kNumberHere || number == least.size()) {
        text += letter;
        continue;
      }
      text += least[number];
      if (largest[number] != least[number]) text += " … " + largest[number];
      ++number;
    }
    return text;
  }
};

std::string failures_part(const std::vector<RunFigures>& runs) {
  std::map<std::string, Failures> by_reason;
  std::size_t failed = 0;
  for (const RunFigures& run : runs) {
    if (run.failure.empty()) continue;
    ++failed;
    const Reason reason = reason_of(run.failure);
    by_reason["subgraph " + run.subgraph + ": " + reason.text].add(reason.numbers);
  }
  if (failed == 0) return "";
  std::vector<std::pair<std::string, Failures>> reasons(by_reason.begin(), by_reason.end());
  std::ranges::stable_sort(reasons, std::ranges::greater{},
                           [](const auto& reason) { return reason.second.count; });
  std::string text = "## Runs that do not count: " + std::to_string(failed) + "\n\n";
  for (std::size_t i = 0; i < std::min(kReasonsShown, reasons.size()); ++i) {
    const auto& [reason, failures] = reasons[i];
    text += "* " + std::to_string(failures.count) + " times " + failures.in_words(reason) + "\n";
  }
  if (reasons.size() > kReasonsShown) {
    text += "* and " + std::to_string(reasons.size() - kReasonsShown) +
            " other reasons, see sweep.csv\n";
  }
  return text + "\n";
}

std::string without_commas(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, '"', '\'');
  return text;
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  assert(runs.size() == sweep.runs().size());
  std::map<std::size_t, double> distances;
  for (const Judged& one : judged(sweep, runs)) {
    distances[one.combination] = one.distance.mean_square;
  }
  std::string text = "run,combination,scenario,subgraph,start";
  for (const SweepAxis& axis : sweep.plan().axes) text += "," + axis.setting;
  text +=
      ",lap_s,error_mean_mm,error_std_mm,generated_max,generated_sum_max,expanded_max,"
      "expanded_sum_max,deviation_max_mm,fallback_steps,distance,failure\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SweepRun& what = sweep.runs()[i];
    const RunFigures& run = runs[i];
    text += std::to_string(i) + "," + std::to_string(what.combination) + "," +
            without_commas(run.scenario) + "," + without_commas(run.subgraph) + "," +
            std::to_string(run.start);
    for (const SweepAxis& axis : sweep.plan().axes) {
      text +=
          "," + value_of(sweep.plan(), sweep.combinations()[what.combination], axis.setting)->text;
    }
    text += "," + number_or_empty(run.lap_s, 4) + "," + number_or_empty(run.error_mean_mm, 4) +
            "," + number_or_empty(run.error_std_mm, 4);
    const bool was_driven = run.error_mean_mm.has_value();
    for (const double value :
         {run.generated_max, run.generated_sum_max, run.expanded_max, run.expanded_sum_max}) {
      text += "," + (was_driven ? number(value, 0) : "");
    }
    text += "," + (was_driven ? number(run.deviation_max_mm, 2) : "") + "," +
            (was_driven ? std::to_string(run.fallback_steps) : "") + ",";
    if (distances.contains(what.combination)) text += number(distances[what.combination], 6);
    text += "," + without_commas(run.failure) + "\n";
  }
  return text;
}

std::string sweep_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs,
                           const EvaluationOrigin& origin) {
  assert(runs.size() == sweep.runs().size());
  const SweepPlan& plan = sweep.plan();
  std::string text =
      "# Sweep " + plan.file.filename().string() + "\n\n" + std::to_string(runs.size()) +
      " runs: " + std::to_string(sweep.combinations().size()) +
      " combinations of settings; scenarios " + std::to_string(plan.scenarios.size()) +
      ", subgraphs " + std::to_string(plan.subgraphs.size()) + ", starts " +
      std::to_string(plan.starts) + ", automata " + std::to_string(sweep.num_automata()) + ".\n\n";
  const bool sweeps_trims = std::ranges::any_of(
      plan.axes, [](const SweepAxis& axis) { return axis.setting == kTrimsSetting; });
  text += sweeps_trims ? trims_markdown(sweep, runs)
                       : paper_part(sweep, runs) + accuracy_comparison(sweep, runs);
  text += failures_part(runs);
  return text + "Command: `" + origin.command + "`\n\nProgram " + origin.revision +
         ", compiled by " + origin.compiler + "; " + origin.processor + ".\n";
}

}  // namespace hlc
