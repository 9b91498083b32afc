#pragma once

#include <string>

namespace hlc {

/// A text as it may stand in XML, between elements or as the value of an attribute in double
/// quotes.
[[nodiscard]] std::string xml_escaped(const std::string& text);

}  // namespace hlc
