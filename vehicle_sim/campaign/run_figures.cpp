#include "vehicle_sim/campaign/run_figures.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "hlc_bridge/result/statistics.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::campaign {
namespace {

std::optional<double> in_mm(const std::optional<result::Statistics>& error_m,
                            double result::Statistics::*value) {
  return error_m ? std::optional(1e3 * ((*error_m).*value)) : std::nullopt;
}

/// Planning times of all vehicles as one sample.
void add_planning(std::span<const result::VehicleSummary> vehicles, RunFigures& figures) {
  double count = 0.0;
  double sum_ms = 0.0;
  double exceeding = 0.0;
  for (const result::VehicleSummary& vehicle : vehicles) {
    if (!vehicle.planning_s) continue;
    const auto plans = static_cast<double>(vehicle.planning_s->count);
    count += plans;
    sum_ms += 1e3 * plans * vehicle.planning_s->mean;
    exceeding += static_cast<double>(vehicle.plans_exceeding_step);
    figures.planning_max_ms = std::max(figures.planning_max_ms, 1e3 * vehicle.planning_s->max);
  }
  if (count == 0.0) return;
  figures.planning_mean_ms = sum_ms / count;
  figures.exceeding_step_share = exceeding / count;
  double squares = 0.0;  // of the deviations from the common mean
  for (const result::VehicleSummary& vehicle : vehicles) {
    if (!vehicle.planning_s) continue;
    const auto plans = static_cast<double>(vehicle.planning_s->count);
    const double off_ms = 1e3 * vehicle.planning_s->mean - figures.planning_mean_ms;
    const double std_ms = 1e3 * vehicle.planning_s->std;
    squares += (plans - 1.0) * std_ms * std_ms + plans * off_ms * off_ms;
  }
  if (count > 1.0) figures.planning_std_ms = std::sqrt(squares / (count - 1.0));
}

}  // namespace

RunFigures with_figures(RunFigures heading, const CampaignResult& result) {
  RunFigures figures = std::move(heading);
  const result::RunSummary& summary = result.summary;
  const result::VehicleSummary& first = summary.vehicles.front();
  figures.failure = result.fault;
  figures.lap_s = first.lap_s;
  figures.error_mean_mm = in_mm(first.reference_error_m, &result::Statistics::mean);
  figures.error_std_mm = in_mm(first.reference_error_m, &result::Statistics::std);
  figures.driven_error_mean_mm = in_mm(first.driven_error_m, &result::Statistics::mean);
  figures.driven_error_std_mm = in_mm(first.driven_error_m, &result::Statistics::std);
  for (const result::VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.generated) {
      figures.generated_max = std::max(figures.generated_max, vehicle.generated->max);
    }
    if (vehicle.expanded) {
      figures.expanded_max = std::max(figures.expanded_max, vehicle.expanded->max);
    }
    figures.deviation_max_mm =
        std::max(figures.deviation_max_mm, 1e3 * vehicle.deviation_max_m.value_or(0.0));
    figures.fallback_steps += vehicle.fallback_steps;
  }
  figures.generated_sum_max = static_cast<double>(summary.generated_vertices_sum_max);
  figures.expanded_sum_max = static_cast<double>(summary.expanded_vertices_sum_max);
  figures.collisions = summary.collisions;
  figures.longest_wait_s = result::longest_wait_s(summary);
  figures.stuck_vehicles = result::stuck_vehicles(summary).size();
  add_planning(summary.vehicles, figures);
  if (const auto steps_s = result::statistics(result.steps_s)) {
    figures.step_p99_ms = 1e3 * steps_s->p99;
    figures.step_max_ms = 1e3 * steps_s->max;
  }
  figures.wall_s = summary.wall_s;
  figures.wall_planning_s = result.wall.planning_s;
  figures.wall_coordination_s = result.wall.coordination_s;
  figures.wall_vehicles_s = result.wall.vehicles_s;
  figures.effort_per_m = result.costs.effort_per_m;
  figures.comfort_per_m = result.costs.comfort_per_m;
  if (result.excess) {
    figures.above_limit_share = result.excess->share;
    figures.clearly_above_limit_share = result.excess->clear_share;
    figures.above_limit_max_mps = result.excess->max_mps;
  }
  figures.switches = result.use.switches;
  figures.subgraph_shares = result.use.shares;
  return figures;
}

}  // namespace hlc::campaign
