#include "vehicle_sim/campaign/sweep_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "planner/common/csv.hpp"
#include "planner/common/demand.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/paper_distance.hpp"
#include "vehicle_sim/campaign/sweep_groups.hpp"

namespace hlc::campaign {
namespace {

std::string without_commas(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  std::ranges::replace(text, '"', '\'');
  return text;
}

}  // namespace

std::string sweep_csv(const Sweep& sweep, const std::vector<RunFigures>& runs) {
  HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
  std::vector<std::string> distances;
  for (const std::vector<std::size_t>& numbers : runs_by_combination(sweep)) {
    std::vector<RunFigures> of_combination;
    for (const std::size_t i : numbers) of_combination.push_back(runs[i]);
    const std::optional<PaperDistance> distance = paper_distance(of_combination);
    distances.push_back(distance ? number(distance->mean_square, 6) : "");
  }
  std::string text = "run,combination,scenario,subgraph,start";
  for (const SweepAxis& axis : sweep.plan().axes) text += "," + axis.setting;
  text +=
      ",lap_s,error_mean_mm,error_std_mm,generated_max,generated_sum_max,expanded_max,"
      "expanded_sum_max,deviation_max_mm,fallback_steps,longest_wait_s,stuck_vehicles,distance,"
      "failure\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SweepRun& what = sweep.runs()[i];
    const RunFigures& run = runs[i];
    CsvLine line(i, what.combination, without_commas(run.scenario), without_commas(run.subgraph),
                 run.start);
    for (const SweepAxis& axis : sweep.plan().axes) {
      line.add(value_of(sweep.plan(), sweep.combinations()[what.combination], axis.setting)->text);
    }
    for (const std::optional<double>& value : {run.lap_s, run.error_mean_mm, run.error_std_mm}) {
      line.add(number(value, 4, ""));
    }
    const bool was_driven = run.error_mean_mm.has_value();
    for (const double value :
         {run.generated_max, run.generated_sum_max, run.expanded_max, run.expanded_sum_max}) {
      line.add(was_driven ? number(value, 0) : "");
    }
    line.add(was_driven ? number(run.deviation_max_mm, 2) : "",
             was_driven ? fmt::to_string(run.fallback_steps) : "",
             was_driven ? number(run.longest_wait_s, 1) : "",
             was_driven ? fmt::to_string(run.stuck_vehicles) : "", distances[what.combination],
             without_commas(run.failure));
    text += line.text();
  }
  return text;
}

}  // namespace hlc::campaign
