#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_summary.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/campaign/driven_costs.hpp"
#include "vehicle_sim/campaign/run_figures.hpp"
#include "vehicle_sim/campaign/subgraph_use.hpp"
#include "vehicle_sim/campaign/zone_excess.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc {

/// What a campaign drives: every combination of scenario, profile, start, and of what is planned
/// on: a fixed subgraph, or the scenario's own with a policy that switches it.
struct CampaignPlan {
  std::vector<std::filesystem::path> scenarios;  ///< files
  std::vector<std::string> profiles;
  std::vector<std::string> subgraphs;   ///< fixed ones; empty: the one that each scenario names
  std::vector<std::string> policies{};  ///< of every scenario
  std::size_t starts{1};
  std::uint64_t seed{1};
  std::optional<std::size_t> steps;  ///< instead of the scenarios'
  std::optional<std::uint64_t> noise_seed;
};

/// One run of a campaign.
struct CampaignRun {
  std::filesystem::path scenario;
  std::string profile;
  std::optional<std::string> subgraph;  ///< none: the scenario's own
  std::optional<std::string> policy;    ///< none: the subgraph is fixed
  std::size_t start{};  ///< 0: where the scenario has the cars; else random, seed + start
};

/// All runs of the plan: by scenario, then profile, then fixed subgraph and policy, then start.
[[nodiscard]] std::vector<CampaignRun> runs_of(const CampaignPlan& plan);

/// What a run of a campaign gives.
struct CampaignResult {
  RunSummary summary;  ///< without revision and host
  std::string fault;   ///< danger_of(summary): why the run does not count; empty if it does
  WallTimes wall;
  DrivenCosts costs;
  std::optional<ZoneExcess> excess;  ///< none without zones, or if nobody came into one
  SubgraphUse use;
};

/// A run with all that was recorded.
struct DrivenRun {
  Scenario scenario;
  Experiment experiment;
};

/// Drives the scenario for the steps that it asks for (not for those of `options`).
[[nodiscard]] DrivenRun drive_run(Scenario scenario, ExperimentOptions options);

/// A run in the terms of summary.json.
/// @param noise_seed  of the measurement noise that it was driven with
/// @param first_step  what lies before is left out: of laps, errors, vertices, faults, costs, hash
/// @param zones       in which speeds are looked at
/// @throws std::runtime_error with the reason if the run was not driven to its end
[[nodiscard]] CampaignResult result_of(const DrivenRun& run,
                                       std::optional<std::uint64_t> noise_seed,
                                       std::uint64_t first_step = 0,
                                       std::span<const SpeedZone> zones = {});

/// Drives the runs of a plan. Automata are built or read once; `drive` may then be called by
/// several threads.
class Campaign {
 public:
  /// Reads every scenario with every profile, subgraph and policy, so that bad input is found
  /// before anything is driven.
  /// @throws std::invalid_argument as read_scenario; for random starts of open paths; for different
  /// scenarios of the same name; for a policy that a scenario does not have, naming `--policies`
  explicit Campaign(CampaignPlan plan);

  [[nodiscard]] const CampaignPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<CampaignRun>& runs() const { return runs_; }

  /// The run number i with its series, for figures: a tenth of a second gives the same again, so
  /// nobody needs to store it.
  [[nodiscard]] DrivenRun drive(std::size_t i, const Clocks& clocks) const;

  /// The same in the terms of summary.json. All runs of a scenario are judged by the same zones:
  /// those of all policies of the campaign.
  /// @throws std::runtime_error with the reason if the run was not driven to its end
  [[nodiscard]] CampaignResult result_of(const DrivenRun& run) const;

  /// The scenario of a run as it was read, with the cars where the scenario has them.
  [[nodiscard]] const Scenario& scenario_of(const CampaignRun& run) const;

  /// All that is read: scenarios, automata, maps, labs.
  [[nodiscard]] std::set<std::filesystem::path> files() const;

  /// Figures of a run without results: scenario, profile, subgraph, policy, start.
  [[nodiscard]] RunFigures heading_of(std::size_t i) const;

 private:
  /// @pre the run's subgraph without a policy is read already
  [[nodiscard]] Scenario read(const CampaignRun& run) const;

  CampaignPlan plan_;
  std::vector<CampaignRun> runs_;
  std::map<std::string, Scenario> scenarios_;  ///< by what distinguishes them beside the start
};

}  // namespace hlc
