#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hlc {

/// Writes a whole file so that a reader sees the old content or the new one, never a part: beside
/// it, then renamed. @throws std::runtime_error naming the file
void write_file(const std::filesystem::path& file, std::string_view content);

/// @throws std::runtime_error naming the file
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

struct CsvRow {
  std::size_t line{};  ///< of the file, from 1, in which it begins
  std::vector<std::string> fields;
};

/// A CSV file of ours. A field in quotes may hold commas, line breaks and, doubled, quotes
/// (RFC 4180); rows end with a line feed.
class CsvTable {
 public:
  /// Reads the file and checks its heading. An incomplete last line (the writer was killed) is left
  /// out. What ends within a quoted field of several lines is no such line, but a quote too many.
  /// @throws std::runtime_error naming file, line and what is expected
  CsvTable(const std::filesystem::path& file, std::string_view heading);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Field of a row, converted. @throws std::runtime_error naming file, line, column and value
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  [[nodiscard]] std::uint64_t unsigned_number(std::size_t row, std::size_t column) const;
  [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
  /// @throws std::runtime_error that says so, for a value of which only the caller knows what is
  /// allowed
  [[noreturn]] void refuse(std::size_t row, std::size_t column, std::string_view allowed) const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<CsvRow> rows_;
};

/// The text as a field of such a file: in quotes if it needs them.
[[nodiscard]] std::string csv_field(const std::string& text);

/// The pieces between separators; one empty piece for an empty text.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace hlc
