#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hlc {

/// Writes the text to a new file beside `path` and renames that: whoever reads `path` sees what was
/// there before or all of the new text, never a part. No other file is touched, and of several
/// writers the last one's text stays, whole.
/// @throws std::runtime_error naming the file if it cannot be written, also if `path` is there and
/// no regular file itself (a link, which the renaming would replace); nothing new is left then
void write_file(const std::filesystem::path& path, std::string_view text);

/// The whole file. @throws std::runtime_error naming the file if it cannot be read
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The same of a file that a user names, which may be a device without end.
/// @param allowed  kind of file, for the message
/// @throws std::invalid_argument naming the file if it is no regular file or cannot be read
[[nodiscard]] std::string read_regular_file(const std::filesystem::path& path,
                                            std::string_view allowed);

/// The pieces between separators; one empty piece for an empty text.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace hlc
