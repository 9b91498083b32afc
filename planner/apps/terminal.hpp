#pragma once

#include <cstddef>
#include <string>

namespace hlc::apps {

/// Of a text that no terminal limits.
inline constexpr std::size_t kPlainColumns = 100;

/// Width for text on a file descriptor: of its terminal; for pipes and files of the environment
/// variable COLUMNS, without it kPlainColumns. At least 40.
[[nodiscard]] std::size_t columns_of(int descriptor);

/// The text in lines of at most `columns` characters, broken at blanks, each begun by `indent`
/// blanks. Its own line breaks stay, and lines of it that begin with two blanks, commands to be
/// copied, are not broken. A word that is too long has a line to itself.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

}  // namespace hlc::apps
