#pragma once

#include <cstddef>

#include "vehicle_sim/apps/sweep_files.hpp"

namespace hlc::apps {

/// Designs the automata and drives the missing runs, `jobs` at a time, with progress lines on
/// stderr. Runs that cannot be driven are recorded with their reason and do not stop the others.
/// @return the number of runs that do not count, including those driven before
std::size_t drive_sweep(campaign::Sweep& sweep, std::size_t jobs, SweepFiles& files);

}  // namespace hlc::apps
