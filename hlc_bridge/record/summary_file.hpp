#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc {

/// summary.json. Lengths in mm, planning times in ms; null where there is no value.
[[nodiscard]] std::string summary_json(const RunSummary& summary);

}  // namespace hlc
