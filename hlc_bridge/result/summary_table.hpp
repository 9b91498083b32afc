#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc {

/// The result as text for people: one row per vehicle as in the paper's Table 2, what concerns all
/// of them below, and what the words mean. Lines of at most 110 columns, ends with a line break.
[[nodiscard]] std::string summary_table(const RunSummary& summary);

}  // namespace hlc
