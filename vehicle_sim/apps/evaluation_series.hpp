#pragma once

#include <cstddef>
#include <filesystem>

#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::apps {

/// Most starts of which series are written: the scenario's own, and others for the spread.
inline constexpr std::size_t kMostStartsInSeries = 32;

/// Writes the series from which vehicle_sim/report draws, into `folder`, which is created:
///
///     steps.csv, drives.csv, distances.csv   campaign/run_series.hpp, by run
///     places.json                            {"scenarios": [scenario_data.hpp],
///                                             "runs": [{"run", "scenario", "profile", "subgraph",
///                                                       "policy", "start", "fault"}]}
///
/// Runs are driven again for them. Those of the first start have all rows, and are driven one at a
/// time, so that planning times are measured without interference; other starts have those of the
/// first vehicle, if that drives the same path. Runs that cannot be driven to their end are left
/// out; "fault" is why a run does not count, empty if it does.
/// @param jobs  runs of the other starts at a time
/// @throws std::runtime_error if a file cannot be written
void write_series(const campaign::Campaign& campaign, std::size_t jobs,
                  const std::filesystem::path& folder);

}  // namespace hlc::apps
