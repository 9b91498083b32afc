#pragma once

#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Quality of a choice of trims: the combination, over all starts of one scenario and subgraph.
struct TrimsQuality {
  std::size_t combination{};
  std::size_t moving{};  ///< enabled moving trims
  double error_mean_mm{};
  double lap_s{};
  double generated_max{};
};

/// The choices that drive a lap from every start, by moving trims, then error.
[[nodiscard]] std::vector<TrimsQuality> trims_that_drive(const Sweep& sweep,
                                                         const std::vector<RunFigures>& runs,
                                                         std::size_t scenario,
                                                         std::size_t subgraph);

/// The choices that no other one dominates, i.e. has fewer or as many moving trims and a smaller or
/// equal mean error, one of the two strictly.
[[nodiscard]] std::vector<TrimsQuality> trims_front(const std::vector<TrimsQuality>& choices);

/// For every scenario and subgraph the front, the smallest choice that is not less accurate than
/// all trims together, and the ranks of the trims that the configuration's own subgraphs have.
/// @pre the plan sets `trims`
[[nodiscard]] std::string trims_markdown(const Sweep& sweep, const std::vector<RunFigures>& runs);

}  // namespace hlc::campaign
