#pragma once

#include <cstddef>
#include <string>

namespace hlc::apps {

/// A text with tables, for lines of at most `columns` characters. Lines that follow each other
/// belong together. Where one of them is too long, and they have blanks in common, they are cut
/// there into parts, one below the other, each begun by the first column. Otherwise a line that is
/// too long goes on in the next one, four blanks farther to the right; a word that is too long has
/// a line to itself.
[[nodiscard]] std::string fitted_table(const std::string& text, std::size_t columns);

/// The same for the terminal of standard output, or the environment variable COLUMNS. Unchanged in
/// pipes and files without that variable, where programs read it.
[[nodiscard]] std::string fitted_table(const std::string& text);

/// Lines of words instead of tables: each that is too long goes on in the next one, as above, even
/// where it has blanks in common with others.
[[nodiscard]] std::string fitted_lines(const std::string& text, std::size_t columns);

/// The same for the terminal, as above.
[[nodiscard]] std::string fitted_lines(const std::string& text);

}  // namespace hlc::apps
