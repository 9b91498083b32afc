#include "tests/integration/run_processes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/report_file.hpp"

namespace hlc::test {
namespace {

constexpr const char* kCommandsFiles = ".commands";

std::filesystem::path new_run_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "hlc_run_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be created");
  std::filesystem::create_directory(name + "/logs");
  return name;
}

}  // namespace

RunProcesses::RunProcesses(scenario::Scenario scenario)
    : scenario_(std::move(scenario)), folder_(new_run_folder()) {}

RunProcesses::~RunProcesses() {
  running_.clear();
  if (!keeps_folder_ && !testing::Test::HasFailure()) {
    std::filesystem::remove_all(folder_);
  } else {
    std::cerr << "the run's files are in " << folder_ << '\n';
  }
}

void RunProcesses::start(const std::string& name, const std::vector<std::string>& command) {
  running_.erase(name);
  running_.emplace(name, ChildProcess(command, log_file(name)));
}

std::vector<std::string> RunProcesses::still_running_after(std::chrono::seconds time) {
  return still_running(running_, time);
}

std::filesystem::path RunProcesses::log_file(const std::string& name) const {
  return folder_ / "logs" / (name + ".log");
}

std::filesystem::path RunProcesses::commands_file(const std::string& recorder) const {
  return folder_ / (recorder + kCommandsFiles);
}

std::vector<ReportRecord> reports_so_far(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / "reports.csv";
  if (read_text(file).find('\n') == std::string::npos) return {};
  return record::read_reports(file);
}

std::vector<ReportRecord> RunProcesses::reports() const { return reports_so_far(folder_); }

result::Drives RunProcesses::drives() const {
  std::vector<std::uint8_t> ids;
  for (const scenario::ScenarioVehicle& vehicle : scenario_.vehicles)
    ids.push_back(vehicle.id.value);
  return record::read_drives(folder_, ids);
}

Commands RunProcesses::commands() const {
  Commands all;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == kCommandsFiles) all.merge(read_commands(entry.path()));
  }
  return all;
}

}  // namespace hlc::test
