#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc::result {

/// The result as text: one row per vehicle as in the paper's Table 2, common figures below, and a
/// legend. Lines of at most 110 columns, ends with a line break.
[[nodiscard]] std::string summary_table(const RunSummary& summary);

}  // namespace hlc::result
