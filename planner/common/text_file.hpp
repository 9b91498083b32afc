#pragma once

#include <cstddef>
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

/// Longest file that a user names (the largest shipped automaton has 23 MB when built), and longest
/// record of a run.
inline constexpr std::size_t kMostInputBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kMostRecordBytes = std::size_t{2} << 30U;

/// The whole file. Opened without waiting, read only if it is a regular file, and no further than
/// the limit: a pipe, a device or a file that grows ends in a message.
/// @throws std::runtime_error naming the file if it cannot be read, is no regular file or is longer
[[nodiscard]] std::string read_file(const std::filesystem::path& path,
                                    std::size_t most_bytes = kMostRecordBytes);

/// The same for a file named by a user, of at most kMostInputBytes.
/// @param allowed  kind of file, for the message
/// @throws std::invalid_argument naming the file
[[nodiscard]] std::string read_regular_file(const std::filesystem::path& path,
                                            std::string_view allowed);

/// The pieces between separators; one empty piece for an empty text.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace hlc
