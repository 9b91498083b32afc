#pragma once

#include <span>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::result {

/// SHA-256 of what was planned and driven, as 64 hexadecimal digits: over the steps in order, in
/// each over the vehicles by id, the planned x, y, heading and the driven x, y, yaw as
/// little-endian IEEE doubles. A driven pose that was not recorded counts as three quiet NaNs
/// (0x7ff8000000000000).
///
/// Equal hashes mean equal bits: 0.0 and -0.0 differ.
/// @pre rows by step, then id
[[nodiscard]] std::string trace_sha256(std::span<const StepRecord> rows);

}  // namespace hlc::result
