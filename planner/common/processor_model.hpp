#pragma once

#include <string>

namespace hlc {

/// Name of this machine's processor; "unknown" where the system does not provide it.
[[nodiscard]] std::string processor_model();

}  // namespace hlc
