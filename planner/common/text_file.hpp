#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hlc {

/// Writes the text to a new file beside `path` and renames it: a reader of `path` sees the old
/// content or all of the new text, never a part. No other file is touched, and of several writers
/// the last one's text remains, complete.
/// @throws std::runtime_error naming the file if it cannot be written, also if `path` exists and is
/// no regular file itself (a link, which the renaming would replace); no new file remains then
void write_file(const std::filesystem::path& path, std::string_view text);

/// The whole file. @throws std::runtime_error naming the file if it cannot be read
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The same for a file named by a user, which may be an endless device.
/// @param allowed  kind of file, for the message
/// @throws std::invalid_argument naming the file if it is no regular file or cannot be read
[[nodiscard]] std::string read_regular_file(const std::filesystem::path& path,
                                            std::string_view allowed);

/// The pieces between separators; one empty piece for an empty text.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace hlc
