#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "planner/policy/policy_settings.hpp"

namespace hlc::campaign {

struct CampaignResult;

/// The figures of one run for tables and reports.
struct RunFigures {
  std::string scenario;
  std::string profile;
  std::string subgraph;                   ///< with a policy: the scenario's own, which it switches
  std::string policy{policy::kNoPolicy};  ///< kNoPolicy: the subgraph was fixed
  std::size_t start{};
  std::string failure;  ///< why it does not count; empty if it does
  /// Of the vehicle of highest priority, as in the paper.
  std::optional<double> lap_s;
  std::optional<double> error_mean_mm;  ///< of planned positions, over the steps
  std::optional<double> error_std_mm;
  std::optional<double> driven_error_mean_mm;  ///< of driven positions, at the same times
  std::optional<double> driven_error_std_mm;
  /// Over all vehicles.
  double generated_max{};      ///< per car and step
  double generated_sum_max{};  ///< summed over the cars of a step
  double expanded_max{};
  double expanded_sum_max{};
  double planning_mean_ms{};  ///< processor time (Clocks::cpu)
  double planning_std_ms{};
  double planning_max_ms{};
  double exceeding_step_share{};  ///< of the plans, those that took longer than a step
  double step_p99_ms{};           ///< of all cars together (Experiment::steps_s)
  double step_max_ms{};
  double deviation_max_mm{};  ///< footprint to plan, any tick; without drift near full lock
  double wall_s{};            ///< of the whole run; its parts as in WallTimes
  double wall_planning_s{};
  double wall_coordination_s{};
  double wall_vehicles_s{};
  std::size_t fallback_steps{};
  std::size_t collisions{};
  double longest_wait_s{};             ///< for others (planner/coordination/waiting.hpp)
  std::size_t stuck_vehicles{};        ///< at the end of the run
  std::optional<double> effort_per_m;  ///< DrivenCosts
  std::optional<double> comfort_per_m;
  std::optional<double> above_limit_share;  ///< ZoneExcess
  std::optional<double> clearly_above_limit_share;
  std::optional<double> above_limit_max_mps;
  std::size_t switches{};                         ///< SubgraphUse
  std::map<std::string, double> subgraph_shares;  ///< by name
};

/// True if the run counts: it was driven to its end, and well (CampaignResult::fault).
[[nodiscard]] inline bool is_well_driven(const RunFigures& run) { return run.failure.empty(); }

/// The figures of a run that was driven to its end.
/// @param heading  scenario, profile, subgraph, policy and start; kept
[[nodiscard]] RunFigures with_figures(RunFigures heading, const CampaignResult& result);

}  // namespace hlc::campaign
