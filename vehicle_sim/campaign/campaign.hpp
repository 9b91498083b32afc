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

namespace hlc::campaign {

/// The runs of a campaign: every combination of scenario, profile, start, and either a fixed
/// subgraph or the scenario's own with a policy that switches it.
struct CampaignPlan {
  std::vector<std::filesystem::path> scenarios;  ///< files
  std::vector<std::string> profiles;
  std::vector<std::string> subgraphs;   ///< fixed ones; empty: the one that each scenario names
  std::vector<std::string> policies{};  ///< of every scenario
  std::size_t starts{1};
  std::uint64_t seed{1};
  /// Instead of the scenarios' (scenario::ScenarioChoices)
  std::optional<std::size_t> steps;
  std::optional<std::filesystem::path> map_file{};
  std::optional<std::size_t> cars{};
  std::optional<std::string> routes{};
  std::optional<std::uint64_t> noise_seed;
};

/// One run of a campaign.
struct CampaignRun {
  std::filesystem::path scenario;
  std::string profile;
  std::optional<std::string> subgraph;  ///< none: the scenario's own
  std::optional<std::string> policy;    ///< none: the subgraph is fixed
  std::size_t start{};  ///< 0: the scenario's own poses; otherwise random, seed + start
};

/// All runs of the plan: by scenario, then profile, then fixed subgraph and policy, then start.
[[nodiscard]] std::vector<CampaignRun> runs_of(const CampaignPlan& plan);

/// The result of a run of a campaign.
struct CampaignResult {
  result::RunSummary summary;  ///< without revision and host
  std::string fault;           ///< danger_of(summary): why the run does not count; empty if it does
  closed_loop::WallTimes wall;
  std::vector<double> steps_s;  ///< Experiment::steps_s
  DrivenCosts costs;
  std::optional<ZoneExcess> excess;  ///< none without zones, or if no car entered one
  SubgraphUse use;
};

/// A run with all its records.
struct DrivenRun {
  scenario::Scenario scenario;
  closed_loop::Experiment experiment;
};

/// Drives the scenario for its own number of steps (not for that of `options`).
[[nodiscard]] DrivenRun drive_run(scenario::Scenario scenario,
                                  closed_loop::ExperimentOptions options);

/// A run as in summary.json.
/// @param noise_seed  of the run's measurement noise
/// @param first_step  earlier steps are excluded: from laps, errors, vertices, faults, costs, hash
/// @param zones       in which speeds are checked
/// @throws std::runtime_error with the reason if the run was not driven to its end
[[nodiscard]] CampaignResult result_of(const DrivenRun& run,
                                       std::optional<std::uint64_t> noise_seed,
                                       std::uint64_t first_step = 0,
                                       std::span<const policy::SpeedZone> zones = {});

/// Drives the runs of a plan. Automata are built or read once; `drive` may then be called by
/// several threads.
class Campaign {
 public:
  /// Reads every scenario with every profile, subgraph and policy, so that invalid input is found
  /// before the first run.
  /// @throws std::invalid_argument as read_scenario; for random starts of open paths; for different
  /// scenarios of the same name; for a policy that a scenario does not have, naming `--policies`
  explicit Campaign(CampaignPlan plan);

  [[nodiscard]] const CampaignPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<CampaignRun>& runs() const { return runs_; }

  /// Run number i with its series, for figures: the series are not stored, since driving again
  /// takes a tenth of a second and gives the same.
  [[nodiscard]] DrivenRun drive(std::size_t i, const closed_loop::Clocks& clocks) const;

  /// The same as in summary.json. All runs of a scenario are evaluated with the same zones: those
  /// of all policies of the campaign.
  /// @throws std::runtime_error with the reason if the run was not driven to its end
  [[nodiscard]] CampaignResult result_of(const DrivenRun& run) const;

  /// The scenario of a run as read, with the scenario's own start poses.
  [[nodiscard]] const scenario::Scenario& scenario_of(const CampaignRun& run) const;

  /// All files read: scenarios, automata, maps, labs.
  [[nodiscard]] std::set<std::filesystem::path> files() const;

  /// Figures of a run without results: scenario, profile, subgraph, policy, start.
  [[nodiscard]] RunFigures heading_of(std::size_t i) const;

 private:
  /// @pre the run's subgraph without a policy is read already
  [[nodiscard]] scenario::Scenario read(const CampaignRun& run) const;

  CampaignPlan plan_;
  std::vector<CampaignRun> runs_;
  /// By what distinguishes them beside the start
  std::map<std::string, scenario::Scenario> scenarios_;
};

}  // namespace hlc::campaign
