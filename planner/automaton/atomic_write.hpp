#pragma once

#include <filesystem>
#include <string>

namespace hlc {

/// Writes the text to a file beside `path` and renames that: whoever reads `path` sees what was
/// there before or all of the new text, never a part.
/// @throws std::runtime_error naming the file if it cannot be written; nothing new is left then
void write_atomically(const std::string& text, const std::filesystem::path& path);

}  // namespace hlc
