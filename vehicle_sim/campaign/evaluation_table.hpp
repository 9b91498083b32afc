#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc {

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
