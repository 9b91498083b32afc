#include "vehicle_sim/campaign/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/common/demand.hpp"
#include "vehicle_sim/campaign/accuracy_comparison.hpp"
#include "vehicle_sim/campaign/failure_list.hpp"
#include "vehicle_sim/campaign/paired_comparison.hpp"
#include "vehicle_sim/campaign/paper_comparison.hpp"
#include "vehicle_sim/campaign/sweep_tables.hpp"
#include "vehicle_sim/campaign/trims_front.hpp"

namespace hlc::campaign {

std::string sweep_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs,
                           const EvaluationOrigin& origin) {
  HLC_DEMAND(runs.size() == sweep.runs().size(), runs.size(), sweep.runs().size());
  const SweepPlan& plan = sweep.plan();
  std::string text = fmt::format(
      "# Sweep {}\n\n{} runs: {} combinations of settings; scenarios {}, subgraphs {}, starts {}, "
      "automata {}.\n\n",
      plan.file.filename().string(), runs.size(), sweep.combinations().size(),
      plan.scenarios.size(), plan.subgraphs.size(), plan.starts, sweep.num_automata());
  const bool sweeps_trims = std::ranges::any_of(
      plan.axes, [](const SweepAxis& axis) { return axis.setting == kTrimsSetting; });
  text += sweeps_trims ? trims_markdown(sweep, runs) : paper_comparison(sweep, runs);
  text += accuracy_comparison(sweep, runs) + paired_comparison(sweep, runs) +
          sweep_tables_markdown(sweep, runs) + failure_list(runs);
  return text + origin_text(origin);
}

}  // namespace hlc::campaign
