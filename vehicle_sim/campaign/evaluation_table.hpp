#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hlc {

/// What the evaluation's table needs of one run.
struct RunFigures {
  std::string scenario;
  std::string profile;
  std::string subgraph;
  std::size_t start{};
  std::string failure;  ///< why it does not count; empty if it does
  /// Of the vehicle of highest priority, as in the paper.
  std::optional<double> lap_s;
  std::optional<double> error_mean_mm;  ///< reference error over the steps
  std::optional<double> error_std_mm;
  /// Over all vehicles.
  double generated_max{};      ///< per car and step
  double generated_sum_max{};  ///< summed over the cars of a step
  double expanded_max{};
  double expanded_sum_max{};
  double planning_mean_ms{};
  double planning_std_ms{};
  double planning_max_ms{};
  double overlong_share{};    ///< of the plans, those that took longer than a step
  double deviation_max_mm{};  ///< footprint to plan, any tick; without drift near full lock
  double wall_s{};            ///< of the whole run; its parts as in WallTimes
  double wall_planning_s{};
  double wall_coordination_s{};
  double wall_vehicles_s{};
  std::size_t fallback_steps{};
  std::size_t collisions{};
};

/// A cell of the paper's Table 2 that does not depend on the machine: reference error, lap,
/// vertices.
struct PapersCell {
  std::string scenario;  ///< paper_three_cars (the paper's simulation), paper_red_alone (its lab)
  std::string subgraph;
  std::string quantity;  ///< its key in the table as comma-separated values
  double value{};
  std::optional<double> (*of)(const RunFigures&){};  ///< ours
};

/// All of them, by scenario, subgraph, quantity.
[[nodiscard]] std::vector<PapersCell> papers_cells();

/// Where the figures come from.
struct EvaluationOrigin {
  std::string command;
  std::string revision;
  std::string compiler;
  std::string processor;
};

/// Markdown: for every scenario and profile a table with a column per subgraph and, for the paper's
/// scenarios (paper_three_cars: its simulation, paper_red_alone: its lab), the paper's own beside
/// it. A cell is the mean over the starts and, with several, their range in brackets. Source:
/// paper, Table 2.
[[nodiscard]] std::string evaluation_markdown(const std::vector<RunFigures>& runs,
                                              const EvaluationOrigin& origin);

/// The same as comma-separated values: one row per scenario, profile, subgraph and quantity, with
/// mean, min and max over the starts and the paper's value.
[[nodiscard]] std::string evaluation_csv(const std::vector<RunFigures>& runs);

}  // namespace hlc
