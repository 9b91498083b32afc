#pragma once

#include <string>

namespace hlc::dds {

/// Of Fast DDS, such as "2.9.1".
[[nodiscard]] std::string library_version();

}  // namespace hlc::dds
