#pragma once

#include <string>

/// Where this build's sources and programs lie, without a slash at the end.
namespace hlc::test {

[[nodiscard]] const std::string& source_folder();
[[nodiscard]] const std::string& build_folder();  ///< build/<preset>

}  // namespace hlc::test
