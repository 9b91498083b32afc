#pragma once

#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::record {

/// The raw records of a run that are missing or end before the run did, as after a full disk or a
/// killed process, one line each: file, where it ends, and where the run does. Nothing for a run
/// that did not start. A run that was not driven to its end ends with the last step reported by any
/// vehicle. In real time a vehicle may leave a step unreported: only the last step of all counts.
/// @param rows  of step_records()
[[nodiscard]] std::vector<std::string> incomplete_files(const result::RunFacts& facts,
                                                        std::span<const result::StepRecord> rows,
                                                        const result::Drives& drives);

}  // namespace hlc::record
