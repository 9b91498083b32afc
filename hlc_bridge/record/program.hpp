#pragma once

#include <string>

#include "hlc_bridge/result/run_summary.hpp"

namespace hlc {

/// `git describe --always --dirty` of the sources that this program was built from; "unknown"
/// without git.
[[nodiscard]] std::string program_revision();

/// The machine that this program runs on; "unknown" where the system does not tell.
[[nodiscard]] Host this_host();

}  // namespace hlc
