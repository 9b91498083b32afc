#include "vehicle_sim/campaign/sweep_report.hpp"

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
  std::string text =
      "# Sweep " + plan.file.filename().string() + "\n\n" + std::to_string(runs.size()) +
      " runs: " + std::to_string(sweep.combinations().size()) +
      " combinations of settings; scenarios " + std::to_string(plan.scenarios.size()) +
      ", subgraphs " + std::to_string(plan.subgraphs.size()) + ", starts " +
      std::to_string(plan.starts) + ", automata " + std::to_string(sweep.num_automata()) + ".\n\n";
  const bool sweeps_trims = std::ranges::any_of(
      plan.axes, [](const SweepAxis& axis) { return axis.setting == kTrimsSetting; });
  text += sweeps_trims ? trims_markdown(sweep, runs) : paper_comparison(sweep, runs);
  text += accuracy_comparison(sweep, runs) + paired_comparison(sweep, runs) +
          sweep_tables_markdown(sweep, runs) + failure_list(runs);
  return text + "Command: `" + origin.command + "`\n\nProgram " + origin.revision +
         ", compiled by " + origin.compiler + "; " + origin.processor + ".\n";
}

}  // namespace hlc::campaign
