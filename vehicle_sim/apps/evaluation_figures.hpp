#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::apps {

/// Names of the figures that an evaluation can draw:
///
/// * `pareto_set`: the paper's Fig. 1, one for each campaign
/// * `automaton`: its Fig. 2, one for each automaton
/// * `scenario`: its Fig. 3, one for each scenario
///
/// and for each scenario and profile:
///
/// * `paths`: its Fig. 4, driven paths of the first vehicle
/// * `error`: its reference error over arc length
/// * `vertices`: generated and expanded over time
/// * `planning_time`: the distribution of planning times
/// * `distance`: distances between vehicles over time, if there are any
/// * `subgraphs`: which subgraph each vehicle planned on over time, and its speed
///
/// The last six are of the first start (the scenario's own poses) and have a line or a panel for
/// every subgraph and policy.
[[nodiscard]] const std::vector<std::string>& figure_names();

struct FigureChoices {
  std::vector<std::string> names;               ///< of figure_names()
  std::filesystem::path pareto_configuration;   ///< automaton configuration for `pareto_set`
  closed_loop::Clocks clocks;                   ///< for `planning_time`
  std::function<void(const std::string&)> log;  ///< called with a line on what is being drawn
};

/// To be called before the first run.
/// @throws std::invalid_argument or std::runtime_error with one line if a file that the figures
/// need cannot be read
void check_figures(const FigureChoices& choices);

/// Draws into `folder`, which is created: NAME.svg, NAME_SCENARIO.svg, NAME_SCENARIO_PROFILE.svg.
/// Runs are driven again for their series, one at a time, so that planning times are measured
/// without interference. A failed run is left out.
/// @throws std::runtime_error if a file cannot be written
/// @return the files
std::vector<std::filesystem::path> draw_figures(const campaign::Campaign& campaign,
                                                const FigureChoices& choices,
                                                const std::filesystem::path& folder);

}  // namespace hlc::apps
