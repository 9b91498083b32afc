#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"
#include "planner/common/program_version.hpp"

namespace hlc::record {

/// The machine that this program runs on; "unknown" where the system does not provide it.
[[nodiscard]] result::Host this_host();

}  // namespace hlc::record
