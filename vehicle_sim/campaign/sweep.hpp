#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/campaign.hpp"
#include "vehicle_sim/campaign/run_figures.hpp"
#include "vehicle_sim/campaign/sweep_plan.hpp"

namespace hlc::campaign {

/// One run of a sweep.
struct SweepRun {
  std::size_t combination{};  ///< index into Sweep::combinations
  std::size_t scenario{};     ///< index into SweepPlan::scenarios
  std::size_t subgraph{};     ///< index into SweepPlan::subgraphs
  std::size_t start{};        ///< as CampaignRun::start
};

/// The result of a run of a sweep. Wall and planning times are 0: a sweep does not measure them.
struct SweepResult {
  RunFigures figures;  ///< `failure`: why the run does not count
  /// Of the evaluated steps; that of the same run in a campaign with a standing lap.
  std::string trace_sha256;
};

/// Drives the runs of a sweep. Automata are designed once for each combination of the settings that
/// affect them.
///
/// To drive run i: first build(automaton_of(i)), once for all runs on that automaton. Different
/// automata may be built, and different runs driven, by several threads.
class Sweep {
 public:
  /// Reads every scenario with every profile, so that invalid input is found before the first run.
  /// @throws std::invalid_argument as read_scenario; for random starts of open paths
  explicit Sweep(SweepPlan plan);

  [[nodiscard]] const SweepPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<SweepCombination>& combinations() const { return combinations_; }
  /// By combination, then scenario, subgraph, start.
  [[nodiscard]] const std::vector<SweepRun>& runs() const { return runs_; }

  /// The subgraphs of the configuration, as it has them.
  [[nodiscard]] const std::vector<automaton::SubgraphSpec>& offered_subgraphs() const {
    return offered_;
  }
  /// The trims of the configuration that are no standstill.
  [[nodiscard]] std::vector<TrimId> moving_trims() const;

  [[nodiscard]] std::size_t num_automata() const { return automata_.size(); }
  [[nodiscard]] std::size_t automaton_of(std::size_t run) const;
  /// A failed design is no error here: the runs on it fail with its reason.
  void build(std::size_t automaton);

  /// All files read: the sweep's own file, scenarios, automaton, maps, labs.
  [[nodiscard]] std::set<std::filesystem::path> files() const;

  /// Figures of a run without results: scenario, profile, subgraph, start.
  [[nodiscard]] RunFigures heading_of(std::size_t run) const;

  /// The run's scenario with the settings applied.
  /// @throws std::invalid_argument, std::runtime_error with the reason if it cannot be driven
  [[nodiscard]] scenario::Scenario scenario_of(std::size_t run) const;

  /// Never throws for a consequence of the settings: a run that cannot be driven fails with its
  /// reason.
  /// @pre its automaton is built
  [[nodiscard]] SweepResult drive(std::size_t run) const;

 private:
  struct DesignedAutomaton {
    maneuver_design::AutomatonConfiguration configuration;
    std::shared_ptr<const automaton::UniversalAutomaton> automaton;
    std::string failure;
  };

  [[nodiscard]] std::string profile_of(const SweepCombination& combination) const;

  SweepPlan plan_;
  std::vector<automaton::SubgraphSpec> offered_;
  std::vector<automaton::Trim> trims_;
  std::vector<SweepCombination> combinations_;
  std::vector<SweepRun> runs_;
  std::vector<DesignedAutomaton> automata_;
  std::vector<std::size_t> automaton_of_;  ///< by combination
  /// As read, by scenario and profile, on the first subgraph of the configuration as it is.
  std::map<std::pair<std::size_t, std::string>, scenario::Scenario> scenarios_;
};

}  // namespace hlc::campaign
