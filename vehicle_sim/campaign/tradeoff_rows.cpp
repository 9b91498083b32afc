#include "vehicle_sim/campaign/tradeoff_rows.hpp"

#include <algorithm>
#include <utility>

#include "planner/geometry/median.hpp"
#include "vehicle_sim/campaign/tradeoff.hpp"

namespace hlc::campaign {
namespace {

std::optional<double> percent(const std::optional<double>& share) {
  return share ? std::optional(100.0 * *share) : std::nullopt;
}

/// Indices into tradeoff_quantities().
enum : std::size_t { kLap, kError, kEffort, kComfort };

std::optional<double> median_of(const TradeoffQuantity& quantity,
                                const std::vector<const RunFigures*>& runs) {
  std::vector<double> values;
  for (const RunFigures* run : runs) {
    if (!has_lap(*run)) continue;
    const std::optional<double> value = quantity.of(*run);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values.empty() ? std::nullopt : std::optional(median(std::move(values)));
}

void evaluate(TradeoffRow& row) {
  for (const TradeoffQuantity& quantity : tradeoff_quantities()) {
    row.medians.push_back(median_of(quantity, row.runs));
  }
  for (const RunFigures* run : row.runs) {
    if (has_lap(*run)) ++row.laps;
    if (is_well_driven(*run)) ++row.good_runs;
    if (run->clearly_above_limit_share.value_or(0.0) > kMostAboveLimit) row.keeps_limits = false;
  }
}

}  // namespace

const std::vector<TradeoffQuantity>& tradeoff_quantities() {
  static const std::vector<TradeoffQuantity> all{
      {"lap [s]", "lap_s", 2, [](const RunFigures& run) { return run.lap_s; }},
      {"error [mm]", "driven_error_mean_mm", 1,
       [](const RunFigures& run) { return run.driven_error_mean_mm; }},
      {"effort per m", "effort_per_m", 3, [](const RunFigures& run) { return run.effort_per_m; }},
      {"comfort per m", "comfort_per_m", 3,
       [](const RunFigures& run) { return run.comfort_per_m; }},
      {"vertices", "generated_max", 0,
       [](const RunFigures& run) { return std::optional(run.generated_max); }},
      {"planning, mean [ms]", "planning_mean_ms", 3,
       [](const RunFigures& run) { return std::optional(run.planning_mean_ms); }},
      {"planning, max. [ms]", "planning_max_ms", 3,
       [](const RunFigures& run) { return std::optional(run.planning_max_ms); }},
      {"above limit [%]", "above_limit_percent", 1,
       [](const RunFigures& run) { return percent(run.above_limit_share); }},
      {"clearly above [%]", "clearly_above_limit_percent", 1,
       [](const RunFigures& run) { return percent(run.clearly_above_limit_share); }},
      {"largest excess [m/s]", "above_limit_max_mps", 3,
       [](const RunFigures& run) { return run.above_limit_max_mps; }},
      {"switches", "switches", 0,
       [](const RunFigures& run) { return std::optional(static_cast<double>(run.switches)); }}};
  return all;
}

const std::vector<TradeoffPair>& tradeoff_pairs() {
  static const std::vector<TradeoffPair> all{{kLap, kEffort}, {kLap, kComfort}, {kError, kEffort}};
  return all;
}

std::string name_of(const TradeoffPair& pair) {
  return tradeoff_quantities()[pair.x].name + ", " + tradeoff_quantities()[pair.y].name;
}

std::vector<TradeoffGroup> tradeoff_groups(const std::vector<RunFigures>& runs) {
  std::vector<TradeoffGroup> groups;
  for (const RunFigures& run : runs) {
    auto group = std::ranges::find_if(groups, [&](const TradeoffGroup& one) {
      return one.scenario == run.scenario && one.profile == run.profile;
    });
    if (group == groups.end()) {
      group = groups.insert(groups.end(), {.scenario = run.scenario, .profile = run.profile});
    }
    auto row = std::ranges::find_if(group->rows, [&](const TradeoffRow& one) {
      return one.first().subgraph == run.subgraph && one.first().policy == run.policy;
    });
    if (row == group->rows.end()) row = group->rows.insert(group->rows.end(), TradeoffRow{});
    row->runs.push_back(&run);
    group->has_zones = group->has_zones || run.above_limit_share.has_value();
  }
  for (TradeoffGroup& group : groups) {
    for (TradeoffRow& row : group.rows) evaluate(row);
  }
  return groups;
}

std::optional<TradeoffCompetition> competition(const TradeoffGroup& group, const TradeoffPair& pair,
                                               bool within_limits) {
  TradeoffCompetition result;
  std::vector<TradeoffPoint> all;
  std::vector<TradeoffPoint> competing;
  for (const TradeoffRow& row : group.rows) {
    if (!row.medians[pair.x] || !row.medians[pair.y]) continue;
    maneuver_design::Objectives values(2);
    values << *row.medians[pair.x], *row.medians[pair.y];
    all.push_back({.is_policy = has_policy(row.first()), .values = values});
    if (within_limits && !row.keeps_limits) continue;
    competing.push_back(all.back());
    result.rows.push_back(&row);
  }
  if (competing.empty()) return std::nullopt;
  result.reference = reference_of(all);
  result.front = front_of(competing, result.reference);
  return result;
}

}  // namespace hlc::campaign
