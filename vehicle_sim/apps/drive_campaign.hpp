#pragma once

#include <cstddef>

#include "vehicle_sim/apps/evaluation_files.hpp"

namespace hlc::apps {

/// Drives the missing runs, `jobs` at a time, with a progress line on stderr. Runs that cannot be
/// driven are recorded with their reason and do not stop the others.
/// @param keep_runs  also writes each run's folder, runs/<number>; a run without one is missing
/// @return the number of runs that do not count, including those driven before
/// @throws std::runtime_error if a record cannot be written
std::size_t drive_campaign(const campaign::Campaign& campaign, std::size_t jobs, bool keep_runs,
                           EvaluationFiles& files);

}  // namespace hlc::apps
