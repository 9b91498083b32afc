#include "vehicle_sim/apps/run_log.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/record/text_file.hpp"

namespace hlc {
namespace {

/// The keys in which two headings differ.
std::string differing_keys(const std::string& there, const std::string& wanted) {
  const auto before = nlohmann::json::parse(there, nullptr, false);
  const auto now = nlohmann::json::parse(wanted);
  if (!before.is_object()) return "first line";
  std::string keys;
  for (const auto& [key, value] : now.items()) {
    if (before.contains(key) && before[key] == value) continue;
    keys += (keys.empty() ? "" : ", ") + key;
  }
  return keys.empty() ? "first line" : keys;
}

}  // namespace

RunLog::RunLog(std::filesystem::path folder, std::string heading)
    : folder_(std::move(folder)), heading_(std::move(heading)) {
  const std::filesystem::path file = folder_ / "runs.jsonl";
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("--out = " + folder_.string() + ": " + what +
                                ", allowed a new folder or that of the same campaign");
  };
  if (!std::filesystem::exists(folder_)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) refuse("cannot be made, " + error.message());
  }
  if (!std::filesystem::is_directory(folder_)) refuse("is no folder");
  if (!std::filesystem::exists(file)) {
    if (!std::filesystem::is_empty(folder_)) refuse("holds something else");
    write_file(file, heading_ + "\n");
    return;
  }
  const std::string text = read_file(file);
  std::vector<std::string> lines = split(text, '\n');
  if (lines.front() != heading_) {
    refuse("holds the campaign of other choices, other files or another program (other " +
           differing_keys(lines.front(), heading_) + ")");
  }
  lines.pop_back();  // behind the last line break: empty, or a line that was not finished
  std::string kept = heading_ + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    try {
      records_[nlohmann::json::parse(lines[i]).at("run").get<std::size_t>()] = lines[i];
    } catch (const nlohmann::json::exception&) {
      refuse("line " + std::to_string(i + 1) + " of runs.jsonl is no record of a run");
    }
    kept += lines[i] + "\n";
  }
  if (kept != text) write_file(file, kept);
}

void RunLog::append(std::size_t run, const std::string& line) {
  const std::lock_guard lock(mutex_);
  const std::filesystem::path file = folder_ / "runs.jsonl";
  const auto size = std::filesystem::file_size(file);
  std::ofstream stream(file, std::ios::app);
  stream << line << '\n' << std::flush;
  if (!stream) {
    // What is half written must not become the begin of the next line.
    stream.close();
    std::filesystem::resize_file(file, size);
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  records_[run] = line;
}

}  // namespace hlc
