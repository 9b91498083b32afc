#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hlc {

/// The text as a CSV field: quoted, with its own quotes doubled, if necessary.
[[nodiscard]] std::string csv_field(std::string_view text);

/// A row under construction. Numbers are written so that they read back to the same bits, truth
/// values as 1 and 0, texts as in csv_field, absent values as an empty field.
class CsvLine {
 public:
  template <class... Fields>
  explicit CsvLine(const Fields&... fields) {
    add(fields...);
  }

  template <class... Fields>
  void add(const Fields&... fields) {
    (add_one(fields), ...);
  }

  /// With the line feed.
  [[nodiscard]] std::string text() const { return text_ + "\n"; }

 private:
  template <class Field>
  void add_one(const Field& field) {
    if constexpr (std::is_floating_point_v<Field>) {
      append(number_text(field));
    } else if constexpr (std::is_integral_v<Field>) {
      append(std::to_string(field));
    } else {
      append(csv_field(field));
    }
  }
  template <class Field>
  void add_one(const std::optional<Field>& field) {
    field ? add_one(*field) : append("");
  }
  [[nodiscard]] static std::string number_text(double value);
  void append(const std::string& field);

  std::string text_;
  bool is_empty_{true};
};

struct CsvRow {
  std::size_t line{};  ///< line of the file, from 1, in which it begins
  std::vector<std::string> fields;
};

/// A CSV file. A quoted field may hold commas, line breaks and, doubled, quotes (RFC 4180).
class CsvTable {
 public:
  /// Reads a file of ours and checks its heading. An incomplete last line (the writer was killed)
  /// is left out. A text that ends within a quoted field of several lines is not such a line, but
  /// has an unmatched quote.
  /// @throws std::runtime_error naming file, line and expectation
  CsvTable(const std::filesystem::path& file, std::string_view heading);
  /// Reads a file of any origin and with any columns: lines may end as on other systems, the last
  /// one without a line break.
  /// @throws std::invalid_argument if it is no regular file or cannot be read, std::runtime_error
  /// as above
  explicit CsvTable(const std::filesystem::path& file);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Nothing if there is no column of that name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;

  /// Field of a row, converted. @throws std::runtime_error naming file, line, column and value
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  [[nodiscard]] std::uint64_t unsigned_number(std::size_t row, std::size_t column) const;
  [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
  /// For a value whose bounds only the caller knows. @throws std::runtime_error naming file, line,
  /// column, value and bound
  [[noreturn]] void refuse(std::size_t row, std::size_t column, std::string_view allowed) const;

 private:
  void add(CsvRow row);

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<CsvRow> rows_;
};

}  // namespace hlc
