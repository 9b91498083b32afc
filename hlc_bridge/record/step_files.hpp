#pragma once

#include <span>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::record {

/// steps.csv: every step of every vehicle, with nothing that depends on the wall clock: two runs of
/// the same scenario in logical time give the same bytes. Driven fields are empty where nothing was
/// recorded; trims are numbered from 1 as in the paper; ids are separated by `;`; names are quoted
/// if they contain commas, quotes or line breaks.
[[nodiscard]] std::string steps_csv(std::span<const result::StepRecord> rows);

/// timing.csv: the measured times of the same steps.
[[nodiscard]] std::string timing_csv(std::span<const result::StepRecord> rows);

}  // namespace hlc::record
