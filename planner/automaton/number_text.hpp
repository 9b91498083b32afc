#pragma once

#include <string>

namespace hlc {

/// The shortest decimal text that reads back (std::from_chars, or any correct reader) to the same
/// bits. @pre finite
[[nodiscard]] std::string to_text(double value);

}  // namespace hlc
