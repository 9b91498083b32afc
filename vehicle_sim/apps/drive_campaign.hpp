#pragma once

#include <cstddef>

#include "vehicle_sim/apps/evaluation_files.hpp"
#include "vehicle_sim/apps/shard.hpp"

namespace hlc::apps {

struct DriveChoices {
  std::size_t jobs{1};  ///< at a time
  /// Also writes each run's folder, runs/<number>; a run without one is missing.
  bool keep_runs{false};
  Shard shard;  ///< the only runs to drive
};

/// Drives the missing runs with a progress line on stderr. Runs that cannot be driven are recorded
/// with their reason and do not stop the others.
/// @throws std::runtime_error if a record cannot be written
void drive_campaign(const campaign::Campaign& campaign, const DriveChoices& choices,
                    EvaluationFiles& files);

}  // namespace hlc::apps
