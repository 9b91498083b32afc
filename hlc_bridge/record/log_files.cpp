#include "hlc_bridge/record/log_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "planner/common/text_file.hpp"

namespace hlc::record {
namespace {

/// Time of the run at this stamp; nothing if the stamp is none.
std::optional<double> run_time_s(const std::string& stamp, const result::RunFacts& facts) {
  std::tm parts{};
  int milliseconds = 0;
  char point = 0;
  std::istringstream text(stamp);
  text >> std::get_time(&parts, "%Y-%m-%d %H:%M:%S") >> point >> milliseconds;
  if (text.fail() || point != '.') return std::nullopt;
  parts.tm_isdst = -1;  // looked up
  const double wall_s = static_cast<double>(std::mktime(&parts)) + 1e-3 * milliseconds;
  const double begin_s = 1e-9 * static_cast<double>(*facts.first_step * facts.period);
  return wall_s - begin_s;
}

/// "[2026-01-31 23:59:59.999] [info] process: text", as the programs log; else only a text.
result::LoggedLine parse_line(const std::string& process, const std::string& line,
                              const result::RunFacts& facts) {
  result::LoggedLine logged{
      .process = process, .stamp = {}, .level = {}, .text = line, .run_s = {}};
  const std::size_t level = line.find("] [");
  const std::size_t text = level == std::string::npos ? level : line.find("] ", level + 3);
  if (!line.starts_with('[') || text == std::string::npos) return logged;
  logged.stamp = line.substr(1, level - 1);
  logged.level = line.substr(level + 3, text - level - 3);
  logged.text = line.substr(text + 2);
  if (logged.text.starts_with(process + ": ")) logged.text.erase(0, process.size() + 2);
  // In logical time the clock of the log is not that of the run.
  if (!facts.simulated_time && facts.first_step) logged.run_s = run_time_s(logged.stamp, facts);
  return logged;
}

std::vector<std::filesystem::path> log_files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const bool is_log = entry.is_regular_file(error) && entry.path().extension() == ".log";
    if (is_log) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// A line with the stamp by which it is sorted.
struct Placed {
  std::string stamp;
  result::LoggedLine line;
};

void add_lines(const std::filesystem::path& file, const result::RunFacts& facts,
               std::vector<Placed>& placed) {
  std::string stamp;
  for (const std::string& text : split(read_file(file), '\n')) {
    if (text.empty()) continue;
    result::LoggedLine line = parse_line(file.stem().string(), text, facts);
    if (!line.stamp.empty()) stamp = line.stamp;
    placed.push_back({stamp, std::move(line)});
  }
}

result::LoggedLine further_lines(const std::string& what, const std::filesystem::path& folder) {
  return {.process = "logs",
          .stamp = {},
          .level = {},
          .text = fmt::format("{}, see the files in {}", what, folder.filename().string()),
          .run_s = {}};
}

/// What the file has from this byte on, up to its last line feed.
std::string complete_lines(const std::filesystem::path& file, std::size_t from) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(from));
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  text.resize(text.rfind('\n') + 1);
  return text;
}

}  // namespace

std::vector<result::LoggedLine> read_logs(const std::filesystem::path& folder,
                                          const result::RunFacts& facts) {
  std::vector<Placed> placed;
  for (const std::filesystem::path& file : log_files_in(folder)) add_lines(file, facts, placed);
  std::ranges::stable_sort(placed, {}, &Placed::stamp);
  std::vector<result::LoggedLine> lines;
  for (Placed& one : placed) {
    if (lines.size() == kMostLoggedLines) break;
    lines.push_back(std::move(one.line));
  }
  if (placed.size() > lines.size()) {
    lines.push_back(
        further_lines(fmt::format("{} further lines", placed.size() - lines.size()), folder));
  }
  return lines;
}

std::vector<result::LoggedLine> GrowingLogs::new_lines(const result::RunFacts& facts) {
  std::vector<result::LoggedLine> lines;
  if (num_lines_ > kMostLoggedLines) return lines;
  for (const std::filesystem::path& file : log_files_in(folder_)) {
    std::size_t& from = read_bytes_[file];
    const std::string text = complete_lines(file, from);
    from += text.size();
    for (const std::string& line : split(text, '\n')) {
      if (!line.empty()) lines.push_back(parse_line(file.stem().string(), line, facts));
    }
  }
  std::ranges::stable_sort(lines, {}, &result::LoggedLine::stamp);
  num_lines_ += lines.size();
  if (num_lines_ > kMostLoggedLines) {
    lines.resize(lines.size() - (num_lines_ - kMostLoggedLines));
    lines.push_back(further_lines("further lines", folder_));
  }
  return lines;
}

}  // namespace hlc::record
