#pragma once

#include <map>
#include <string>

namespace hlc::view {

/// The files of the folder `page` by name. They are a part of the program (embed.cmake), so that it
/// finds them wherever it is copied.
[[nodiscard]] const std::map<std::string, std::string>& page_files();

/// Those of the folder `picture`.
[[nodiscard]] const std::map<std::string, std::string>& picture_files();

}  // namespace hlc::view
