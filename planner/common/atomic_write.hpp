#pragma once

#include <filesystem>
#include <string_view>

namespace hlc {

/// Writes the text to a new file beside `path` and renames that: whoever reads `path` sees what was
/// there before or all of the new text, never a part. No other file is touched, and of several
/// writers the last one's text stays, whole.
/// @throws std::runtime_error naming the file if it cannot be written, also if `path` is there and
/// no regular file itself (a link, which the renaming would replace); nothing new is left then
void write_atomically(std::string_view text, const std::filesystem::path& path);

}  // namespace hlc
