#include "hlc_bridge/record/text_file.hpp"

#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "planner/automaton/atomic_write.hpp"

namespace hlc {
namespace {

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view content) {
  write_atomically(content, file);
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream{file, std::ios::binary};
  std::string content{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream || stream.bad()) {
    throw std::runtime_error(file.string() + ": cannot be read");
  }
  return content;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || text[i] == separator) {
      pieces.emplace_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  return pieces;
}

CsvTable::CsvTable(const std::filesystem::path& file, std::string_view heading)
    : file_{file}, columns_{split(heading, ',')} {
  const std::string content = read_file(file);
  std::vector<std::string> lines = split(content, '\n');
  lines.pop_back();  // what follows the last line break: nothing, or an incomplete line
  if (lines.empty() || lines.front() != heading) {
    throw std::runtime_error(file.string() + ":1: the heading must be " + std::string{heading});
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    rows_.push_back(split(lines[i], ','));
    if (rows_.back().size() != columns_.size()) {
      throw std::runtime_error(file.string() + ":" + std::to_string(i + 1) + ": " +
                               std::to_string(rows_.back().size()) + " fields, must be " +
                               std::to_string(columns_.size()));
    }
  }
}

const std::string& CsvTable::text(std::size_t row, std::size_t column) const {
  return rows_.at(row).at(column);
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
    refuse(row, column, "a whole number, not negative");
  }
  return value;
}

void CsvTable::refuse(std::size_t row, std::size_t column, std::string_view allowed) const {
  throw std::runtime_error(file_.string() + ":" + std::to_string(row + 2) + ": " +
                           columns_.at(column) + " = \"" + text(row, column) + "\", allowed " +
                           std::string{allowed});
}

}  // namespace hlc
