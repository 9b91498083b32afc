#pragma once

#include <cstdint>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fault_plan.hpp"
#include "vehicle_sim/closed_loop/process_factory.hpp"
#include "vehicle_sim/closed_loop/run_monitor.hpp"

namespace hlc::closed_loop {

struct FaultRunSettings {
  LabSettings lab;
  std::vector<Fault> faults;
  /// Real time: duration of the run after the last fault; longer than PlanningCheck::kPatience.
  Nanoseconds calm{6 * kNanosecondsPerSecond};
  bool keeps_records{};  ///< FaultRunResult::records
};

/// A whole run of the scenario with faults, in memory: the machines of all its processes, each with
/// clocks of its own, connected by a simulated network.
/// Real time: faults happen, from before the start on; the calm; then the lab control is
/// interrupted, and all must leave. A death does not end the run (OnDeath::kContinue). Logical
/// time: a run of some steps, or fewer if a process dies.
///
/// A killed process is restarted at the end of the fault, a vehicle at its last pose.
/// @throws std::invalid_argument where the machines do
[[nodiscard]] FaultRunResult run_with_faults(const scenario::Scenario& scenario,
                                             const FaultRunSettings& settings,
                                             const Trace& trace = {});

}  // namespace hlc::closed_loop
