#include "planner/common/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Splits a CSV text row by row.
class RowScanner {
 public:
  /// @param begin  of a row
  /// @param line   in which it begins, from 1
  RowScanner(const std::filesystem::path& file, std::string_view text, std::size_t begin,
             std::size_t line)
      : file_{file}, text_{text}, at_{begin}, line_{line} {}

  /// Nothing if the text ends before the row does.
  std::optional<CsvRow> next() {
    CsvRow row{.line = line_, .fields = {}};
    while (true) {
      std::optional<std::string> field = is_at('"') ? quoted() : plain();
      if (!field || at_ == text_.size()) return std::nullopt;
      row.fields.push_back(std::move(*field));
      if (text_[at_++] == '\n') break;
    }
    ++line_;
    return row;
  }

 private:
  [[nodiscard]] bool is_at(char c) const { return at_ < text_.size() && text_[at_] == c; }

  [[noreturn]] void refuse(std::size_t line, const std::string& what) const {
    throw std::runtime_error(
        fmt::format("{}:{}: {}, quotes must be around a whole field, doubled within it",
                    file_.string(), line, what));
  }

  std::string plain() {
    const std::size_t end = std::min(text_.find_first_of(",\n\"", at_), text_.size());
    std::string field{text_.substr(at_, end - at_)};
    at_ = end;
    if (is_at('"')) refuse(line_, "a quote within a field");
    return field;
  }

  /// Nothing if the text ends within the field.
  std::optional<std::string> quoted() {
    const std::size_t begin_line = line_;
    std::string field;
    for (++at_; at_ < text_.size(); ++at_) {
      if (is_at('"') && text_.substr(at_, 2) != "\"\"") {
        ++at_;
        if (at_ < text_.size() && !is_at(',') && !is_at('\n')) {
          refuse(line_, "more behind a closing quote");
        }
        return field;
      }
      if (is_at('"')) ++at_;
      if (is_at('\n')) ++line_;
      field += text_[at_];
    }
    if (line_ != begin_line) refuse(begin_line, "a quote that is not closed");
    return std::nullopt;
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::size_t at_;
  std::size_t line_;
};

}  // namespace

std::string csv_field(std::string_view text) {
  std::string field{text};
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return field;
  for (std::size_t at = 0; (at = field.find('"', at)) != std::string::npos; at += 2) {
    field.insert(at, 1, '"');
  }
  return '"' + field + '"';
}

std::string CsvLine::number_text(double value) { return shortest_text(value); }

void CsvLine::append(const std::string& field) {
  text_ += (is_empty_ ? "" : ",") + field;
  is_empty_ = false;
}

CsvTable::CsvTable(const std::filesystem::path& file, std::string_view heading)
    : file_{file}, columns_{split(heading, ',')} {
  const std::string content = read_file(file);
  const std::size_t end = content.find('\n');
  if (end == std::string::npos || std::string_view{content}.substr(0, end) != heading) {
    throw std::runtime_error(fmt::format("{}:1: the heading must be {}", file.string(), heading));
  }
  RowScanner scanner{file_, content, end + 1, 2};
  while (std::optional<CsvRow> row = scanner.next()) add(*std::move(row));
}

CsvTable::CsvTable(const std::filesystem::path& file) : file_{file} {
  std::string content = read_regular_file(file, "a CSV file");
  std::erase(content, '\r');
  if (!content.ends_with('\n')) content += '\n';
  RowScanner scanner{file_, content, 0, 1};
  if (std::optional<CsvRow> heading = scanner.next()) columns_ = std::move(heading->fields);
  while (std::optional<CsvRow> row = scanner.next()) add(*std::move(row));
}

void CsvTable::add(CsvRow row) {
  if (row.fields.size() != columns_.size()) {
    throw std::runtime_error(fmt::format("{}:{}: {} fields, must be {}", file_.string(), row.line,
                                         row.fields.size(), columns_.size()));
  }
  rows_.push_back(std::move(row));
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::ranges::find(columns_, column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& CsvTable::text(std::size_t row, std::size_t column) const {
  return rows_.at(row).fields.at(column);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  double value{};
  if (!parse(text(row, column), value)) {
    refuse(row, column, "a number");
  }
  return value;
}

std::uint64_t CsvTable::unsigned_number(std::size_t row, std::size_t column) const {
  std::uint64_t value{};
  if (!parse(text(row, column), value)) {
    refuse(row, column, "a whole number >= 0");
  }
  return value;
}

void CsvTable::refuse(std::size_t row, std::size_t column, std::string_view allowed) const {
  throw std::runtime_error(fmt::format("{}:{}: {} = \"{}\", must be {}", file_.string(),
                                       rows_.at(row).line, columns_.at(column), text(row, column),
                                       allowed));
}

}  // namespace hlc
