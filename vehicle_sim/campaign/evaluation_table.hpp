#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::campaign {

/// Origin of the figures.
struct EvaluationOrigin {
  std::string command;
  std::string revision;
  std::string compiler;
  std::string processor;
};

/// The report's last lines: command, program and processor.
[[nodiscard]] std::string origin_text(const EvaluationOrigin& origin);

/// Markdown: for every scenario and profile a table with a column per fixed subgraph and per policy
/// and, for the paper's scenarios (paper_three_cars: its simulation, paper_red_alone: its lab), the
/// paper's own beside it. A cell is the mean over the starts and, with several, their range in
/// brackets. Source: paper, Table 2.
[[nodiscard]] std::string evaluation_markdown(const std::vector<RunFigures>& runs,
                                              const EvaluationOrigin& origin);

/// The same as comma-separated values: one row per scenario, profile, subgraph, policy and
/// quantity, with mean, min and max over the starts and the paper's value.
[[nodiscard]] std::string evaluation_csv(const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
