#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hlc::apps {

/// The content of a runs.jsonl.
struct RunRows {
  std::string heading;                      ///< its first line
  std::map<std::size_t, std::string> rows;  ///< one line of JSON each, by run
};

/// An incomplete last line is dropped. Of several rows of a run the last one counts: it was driven
/// again.
/// @throws std::invalid_argument "line 3 ... is no record of a run, or was changed", without the
/// file's name
[[nodiscard]] RunRows parse_run_rows(const std::string& text);

/// In what a heading differs from the one wanted, with its own values: "seed 2, files town.yaml".
[[nodiscard]] std::string differing_keys(const std::string& heading, const std::string& wanted);

/// The file runs.jsonl in the folder of a campaign or sweep: a first line that identifies the
/// campaign, then a line per run, written once it is driven; its last key, "check", shows whether
/// it was changed (16 digits of the SHA-256 of the line without that key). An interrupted campaign
/// continues with the missing runs.
class RunLog {
 public:
  /// Makes the folder, or opens that of the same campaign, locked for this object's lifetime. An
  /// incomplete last line is dropped.
  /// @param heading  one line of JSON
  /// @throws std::invalid_argument naming the folder if it holds anything else, or a campaign with
  /// another heading (with the difference), if another program has it locked, or if it is not
  /// writable
  RunLog(std::filesystem::path folder, std::string heading);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Checks every record.
  /// @param num_runs  upper bound (excluded) of the runs' numbers
  /// @param read      throws any exception if the record is invalid
  /// @throws std::invalid_argument naming the file and the run
  void check(std::size_t num_runs,
             const std::function<void(std::size_t run, const nlohmann::ordered_json&)>& read) const;
  /// @throws std::invalid_argument if one of these names exists and is not a file
  void check_outputs(const std::vector<std::string>& names) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::string& heading() const { return heading_; }
  [[nodiscard]] bool has(std::size_t run) const { return records_.contains(run); }
  [[nodiscard]] std::size_t size() const { return records_.size(); }
  /// One line of JSON each, by run.
  [[nodiscard]] const std::map<std::size_t, std::string>& records() const { return records_; }

  /// From any thread.
  /// @param line  of JSON, with "run" as a key
  /// @throws std::runtime_error if it cannot be written; the file is then unchanged
  void append(std::size_t run, const std::string& line);

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void lock();
  void open();

  std::filesystem::path folder_;
  std::string heading_;
  std::map<std::size_t, std::string> records_;  ///< as RunRows::rows
  std::mutex mutex_;
  int lock_{-1};  ///< on the folder
};

}  // namespace hlc::apps
