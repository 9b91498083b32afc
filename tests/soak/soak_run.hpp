#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/soak/fault_plan.hpp"

namespace hlc::test {

/// What became of one run.
struct SoakResult {
  std::size_t faults_done{};               ///< those that met a process that still ran
  std::optional<int> lab_control;          ///< its exit code, if it was not killed
  std::size_t collisions{};                ///< of driven footprints
  std::optional<double> min_distance_m{};  ///< of them, over the whole run
  std::vector<std::string> problems;       ///< one line each; empty: good
  bool may_leave_files{};  ///< a process killed on the lab's transport cannot clean up
  double standstill_s{};   ///< for how long the machine did not run, the longest time
  // of runs without faults:
  std::size_t deadline_misses{};  ///< of all cars
  std::size_t fallback_steps{};
  double planning_max_s{};
};

/// Three cars in real time, struck by the faults; a fault whose process has ended is left out. Good
/// if no driven footprints touch, and within a minute of the last fault every process has ended and
/// left nothing.
/// @param transport  loopback: the paper's cars; lab: the lab's cars, and files in /dev/shm are not
///                   judged. Of runs on one machine
/// @param keep       the run's folder is kept if it was not good
[[nodiscard]] SoakResult run_with_faults(const FaultPlan& plan, const std::string& transport,
                                         bool keep);

/// Three cars that start and stop: in logical time and in real time in turn, by the end of three
/// steps and by an interruption in turn. Good if every process ends with the exit code for
/// so.
[[nodiscard]] SoakResult run_cycle(std::size_t number, bool keep);

/// Three cars in real time for so many steps. Good if the run is complete and without
/// collision. Late steps are counted: they are the machine's as much as ours.
[[nodiscard]] SoakResult run_undisturbed(int steps, const std::string& transport, bool keep);

}  // namespace hlc::test
