#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/integration/recorded_commands.hpp"
#include "tests/support/child_process.hpp"

namespace hlc::test {

/// Of a run that is under way; none while there is no file with a heading.
[[nodiscard]] std::vector<ReportRecord> reports_so_far(const std::filesystem::path& run_folder);

/// The programs of one run, each known by its name, and the folder that they write to. Running
/// ones end with this object.
class RunProcesses {
 public:
  RunProcesses(const RunProcesses&) = delete;
  RunProcesses& operator=(const RunProcesses&) = delete;

  void keep_folder() { keeps_folder_ = true; }

  [[nodiscard]] ChildProcess& operator[](const std::string& name) { return running_.at(name); }
  /// Waits for all that were started. Names of those that still run at the deadline.
  [[nodiscard]] std::vector<std::string> still_running_after(std::chrono::seconds time);

  [[nodiscard]] const scenario::Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// What the process has printed.
  [[nodiscard]] std::string log(const std::string& name) const { return read_text(log_file(name)); }
  /// So far; as are drives and commands.
  [[nodiscard]] std::vector<ReportRecord> reports() const;
  /// The vehicles' own records.
  [[nodiscard]] result::Drives drives() const;
  /// Of all command_recorders.
  [[nodiscard]] Commands commands() const;

 protected:
  explicit RunProcesses(scenario::Scenario scenario);
  /// Keeps the folder if the test has failed, or if `keep_folder` was called.
  ~RunProcesses();

  /// Nothing is left of a process that bore the name before, nor of its log.
  void start(const std::string& name, const std::vector<std::string>& command);

  [[nodiscard]] std::filesystem::path log_file(const std::string& name) const;
  /// Where a command_recorder writes to.
  [[nodiscard]] std::filesystem::path commands_file(const std::string& recorder) const;

 private:
  scenario::Scenario scenario_;
  std::filesystem::path folder_;
  bool keeps_folder_{};
  std::map<std::string, ChildProcess> running_;
};

}  // namespace hlc::test
