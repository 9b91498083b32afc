#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc::record {

/// summary.json. Lengths in mm, planning times in ms; null where there is no value.
[[nodiscard]] std::string summary_json(const result::RunSummary& summary);

}  // namespace hlc::record
