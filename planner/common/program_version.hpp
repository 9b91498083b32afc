#pragma once

#include <string>

namespace hlc {

/// The project's version (CMakeLists.txt), as "0.1.0".
[[nodiscard]] std::string program_release();

/// `git describe --always --dirty` of the sources that this program was built from; "unknown"
/// without git.
[[nodiscard]] std::string program_revision();

}  // namespace hlc
