#pragma once

#include <filesystem>
#include <string_view>

namespace hlc {

/// Writes the text to a file beside `path` and renames that: whoever reads `path` sees what was
/// there before or all of the new text, never a part.
/// @throws std::runtime_error naming the file if it cannot be written; nothing new is left then
void write_atomically(std::string_view text, const std::filesystem::path& path);

}  // namespace hlc
