#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/integration/run_processes.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::test {

struct LabOptions {
  std::string scenario{"paper_three_cars"};  ///< shipped one, or a file *.yaml
  std::string profile{"default"};
  std::optional<std::size_t> cars{};  ///< instead of the scenario's
  std::string policy{};               ///< instead of the scenario's
  std::string map_file{};             ///< instead of the scenario's
  int steps{25};
  bool simulated_time{true};
  std::optional<std::uint64_t> noise_seed;     ///< vehicle i has noise_seed + i
  std::vector<std::string> vehicle_flags;      ///< further flags of every vehicle_sim
  std::vector<std::string> lab_control_flags;  ///< further ones
  std::vector<std::string> absent;             ///< processes that are not started
  int startup_timeout_s{60};                   ///< of lab control; the others wait 10 s longer
  std::string transport{"loopback"};           ///< or "lab": as root with a /dev/shm of their own
  std::string security{};                      ///< folder of make_security.sh
  bool records_messages{};                     ///< in the folder messages
  bool records_commands{};                     ///< with a command_recorder, which ends by itself
};

/// All processes of a run, started one by one in any order, each known by its name: lab_control,
/// vehicle_1, middleware_1, high_level_controller_1, ... Own folder, and own DDS domains, which are
/// free for others when all processes have ended.
class LabProcesses : private DomainReservation, public RunProcesses {
 public:
  explicit LabProcesses(const LabOptions& options);

  [[nodiscard]] std::vector<std::string> names() const;
  /// May be repeated after the end of the process, with a new log.
  void start(const std::string& name) { RunProcesses::start(name, commands_.at(name)); }
  void start_all();
  /// Exit code of summarize.
  int summarize();

  [[nodiscard]] int lab_domain() const { return first(); }

 private:
  LabProcesses(const LabOptions& options, scenario::Scenario given);

  std::map<std::string, std::vector<std::string>> commands_;
  std::vector<std::string> scenario_flags_;
};

/// Drives the whole run, which must succeed. trace_sha256 of its summary.
[[nodiscard]] std::string trace_of(LabProcesses& lab);

}  // namespace hlc::test
