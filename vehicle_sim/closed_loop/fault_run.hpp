#pragma once

#include <cstdint>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fault_plan.hpp"
#include "vehicle_sim/closed_loop/process_factory.hpp"
#include "vehicle_sim/closed_loop/run_judges.hpp"

namespace hlc::closed_loop {

struct FaultRunSettings {
  LabSettings lab;
  std::vector<Fault> faults;
  /// Real time: the run goes on for so long after the last fault; longer than
  /// PlanningCheck::kPatience.
  Nanoseconds calm{6 * kNanosecondsPerSecond};
};

/// A whole run of the scenario with faults, in memory: the machines of all its processes, each with
/// clocks of its own, connected by a simulated network.
///
/// Real time: faults happen, from before the start on; the calm; then the lab control is
/// interrupted, and everybody must leave. A death does not end the run (OnDeath::kContinue).
/// Logical time: a run of some steps, or less if somebody dies.
///
/// A process that is killed is started again by whoever killed it, a vehicle where it stands.
/// @throws std::invalid_argument where the machines do
[[nodiscard]] FaultRunResult run_with_faults(const Scenario& scenario,
                                             const FaultRunSettings& settings,
                                             const Trace& trace = {});

}  // namespace hlc::closed_loop
