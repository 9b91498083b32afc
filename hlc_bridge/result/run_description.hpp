#pragma once

#include <optional>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::result {

/// Description of a run of the scenario, as needed for its result.
/// @param noise_seed  of the measurement noise; none: the cars measure exactly
[[nodiscard]] RunDescription describe(const scenario::Scenario& scenario,
                                      std::optional<std::uint64_t> noise_seed);

/// @throws std::runtime_error naming the key of run.json if the run is not of this scenario
void check_run(const RunFacts& facts, const RunDescription& description);

}  // namespace hlc::result
