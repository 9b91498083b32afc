#include "vehicle_sim/apps/run_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "planner/common/sha256.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Short values as they are; empty for long ones.
std::string text_of(const Json& value) {
  const std::string text = value.dump();
  return value.is_array() && text.size() > 40 ? "" : " " + text;
}

/// Which of the campaign's input files have changed.
std::string differing_files(const Json& before, const Json& now) {
  std::string names;
  for (const Json& file : now) {
    if (std::find(before.begin(), before.end(), file) != before.end()) continue;
    if (file.is_object()) names += " " + file.value("file", std::string{});
  }
  return names;
}

constexpr std::string_view kCheck = ",\"check\":\"";
constexpr std::size_t kDigits = 16;

/// The line with a key more, the begin of its hash.
std::string sealed(const std::string& line) {
  return fmt::format("{}{}{}\"}}", line.substr(0, line.size() - 1), kCheck,
                     sha256_of(line).substr(0, kDigits));
}

/// What `sealed` was given; none if this is not its result.
std::optional<std::string> unsealed(const std::string& line) {
  const std::size_t length = kCheck.size() + kDigits + 2;
  if (line.size() <= length) return std::nullopt;
  const std::string bare = line.substr(0, line.size() - length) + "}";
  return sealed(bare) == line ? std::optional(bare) : std::nullopt;
}

}  // namespace

std::string differing_keys(const std::string& there, const std::string& wanted) {
  const Json before = Json::parse(there, nullptr, false);
  const Json now = Json::parse(wanted);
  if (!before.is_object()) return "first line";
  std::vector<std::string> keys;
  for (const auto& [key, value] : now.items()) {
    if (key == "runs") continue;  // their number follows from the choices
    if (before.contains(key) && before[key] == value) continue;
    keys.push_back(key);
    if (!before.contains(key)) continue;
    if (key == "files") {
      keys.back() += differing_files(before[key], value);
    } else if (key != "program") {
      keys.back() += text_of(before[key]);
    }
  }
  return keys.empty() ? "first line" : fmt::format("{}", fmt::join(keys, ", "));
}

RunRows parse_run_rows(const std::string& text) {
  std::vector<std::string> lines = split(text, '\n');
  RunRows rows{.heading = lines.front(), .rows = {}};
  lines.pop_back();  // behind the last line break: empty, or an incomplete line
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::optional<std::string> row = unsealed(lines[i]);
    const Json record = row ? Json::parse(*row, nullptr, false) : Json();
    if (!record.is_object() || !record.contains("run") || !record["run"].is_number_unsigned()) {
      throw std::invalid_argument(
          fmt::format("line {} of runs.jsonl is no record of a run, or was changed", i + 1));
    }
    rows.rows[record["run"].get<std::size_t>()] = *std::move(row);
  }
  return rows;
}

RunLog::RunLog(std::filesystem::path folder, std::string heading)
    : folder_(std::move(folder)), heading_(std::move(heading)) {
  if (!std::filesystem::exists(folder_)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) {
      throw std::invalid_argument(
          fmt::format("--out = {}: cannot be created, {}, must be a writable folder",
                      folder_.string(), error.message()));
    }
  }
  if (!std::filesystem::is_directory(folder_)) refuse("is not a folder");
  lock();
  try {
    open();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

RunLog::~RunLog() { ::close(lock_); }

void RunLog::refuse(const std::string& what) const {
  throw std::invalid_argument(fmt::format(
      "--out = {}: {}, must be a new folder or that of the same campaign", folder_.string(), what));
}

void RunLog::lock() {
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  const int reason = errno;
  if (lock_ >= 0) ::close(lock_);
  const std::string out = "--out = " + folder_.string() + ": ";
  if (reason == EWOULDBLOCK) {
    throw std::invalid_argument(out + "another evaluate is running there, must be one at a time");
  }
  throw std::invalid_argument(out + "cannot be locked, " + std::generic_category().message(reason) +
                              ", must be a readable and writable folder");
}

void RunLog::open() {
  const std::filesystem::path file = folder_ / "runs.jsonl";
  const auto write = [&](const std::string& text) {
    try {
      write_file(file, text);
    } catch (const std::exception& error) {
      throw std::invalid_argument(error.what());
    }
  };
  if (!std::filesystem::exists(file)) {
    if (!std::filesystem::is_empty(folder_)) refuse("contains other files");
    write(heading_ + "\n");
    return;
  }
  if (!std::filesystem::is_regular_file(file)) refuse("contains other files");
  const std::string text = read_file(file);
  const std::string heading = text.substr(0, text.find('\n'));
  if (heading != heading_) {
    refuse("contains another campaign: other choices, files or program (there: " +
           differing_keys(heading, heading_) + ")");
  }
  try {
    records_ = parse_run_rows(text).rows;
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
  const std::string kept = text.substr(0, text.rfind('\n') + 1);
  if (kept.empty()) {
    write(heading_ + "\n");
  } else if (kept != text) {
    write(kept);
  }
}

void RunLog::check(std::size_t num_runs,
                   const std::function<void(std::size_t run, const Json&)>& read) const {
  for (const auto& [run, line] : records_) {
    const std::string record = fmt::format("the record of run {} in runs.jsonl ", run);
    if (run >= num_runs) refuse(fmt::format("{}is none of this campaign's {}", record, num_runs));
    try {
      read(run, Json::parse(line));
    } catch (const std::exception&) {
      refuse(record + "is damaged");
    }
  }
}

void RunLog::check_outputs(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const std::filesystem::path file = folder_ / name;
    if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)) {
      refuse(name + " in it is no file");
    }
  }
}

void RunLog::append(std::size_t run, const std::string& line) {
  const std::lock_guard lock(mutex_);
  const std::filesystem::path file = folder_ / "runs.jsonl";
  const auto size = std::filesystem::file_size(file);
  std::ofstream stream(file, std::ios::app);
  stream << sealed(line) << '\n' << std::flush;
  if (!stream) {
    // An incomplete line must not become the begin of the next one.
    stream.close();
    std::filesystem::resize_file(file, size);
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  records_[run] = line;
}

}  // namespace hlc::apps
