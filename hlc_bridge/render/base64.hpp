#pragma once

#include <string>
#include <string_view>

namespace hlc::render {

/// The bytes of a text in base64 (RFC 4648, section 4).
/// @throws std::invalid_argument for other characters
[[nodiscard]] std::string bytes_of_base64(std::string_view text);

}  // namespace hlc::render
