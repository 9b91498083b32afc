#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::test {

struct LabOptions {
  std::string scenario{"paper_three_cars"};  ///< shipped one, or a file *.yaml
  std::string profile{"default"};
  std::string map_file{};  ///< instead of the scenario's
  int steps{25};
  bool simulated_time{true};
  std::optional<std::uint64_t> noise_seed;     ///< vehicle i has noise_seed + i
  std::vector<std::string> vehicle_flags;      ///< further flags of every vehicle_sim
  std::vector<std::string> lab_control_flags;  ///< further ones
  std::vector<std::string> absent;             ///< processes that are not started
  int startup_timeout_s{60};                   ///< of lab control; the others wait 10 s longer
  std::string transport{"loopback"};
  bool records_commands{};  ///< with a command_recorder, which ends by itself
};

/// All processes of a run, started one by one in any order, each known by its name: lab_control,
/// vehicle_1, middleware_1, high_level_controller_1, ... Own DDS domains, own folder.
class LabProcesses {
 public:
  explicit LabProcesses(const LabOptions& options);
  /// Keeps the run folder if the test has failed, or if `keep_folder` was called.
  ~LabProcesses();
  void keep_folder() { keeps_folder_ = true; }

  [[nodiscard]] std::vector<std::string> names() const;
  void start(const std::string& name);
  void start_all();
  /// Once more, after its end. Its log begins anew.
  void start_again(const std::string& name);

  [[nodiscard]] ChildProcess& operator[](const std::string& name) { return running_.at(name); }
  /// Waits for all that were started. Names of those that still run at the deadline.
  [[nodiscard]] std::vector<std::string> still_running_after(std::chrono::seconds time);
  /// Exit code of summarize.
  int summarize();

  [[nodiscard]] int lab_domain() const { return domains_.first(); }
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::string log(const std::string& name) const;
  /// Of the command_recorder.
  [[nodiscard]] std::filesystem::path commands_file() const { return folder_ / "commands.txt"; }

 private:
  std::map<std::string, std::vector<std::string>> commands_;
  DomainReservation domains_;
  std::filesystem::path folder_;
  ScenarioChoices choices_;
  Scenario scenario_;
  bool keeps_folder_{};
  std::map<std::string, ChildProcess> running_;
};

}  // namespace hlc::test
