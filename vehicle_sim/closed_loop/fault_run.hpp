#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fault_plan.hpp"
#include "vehicle_sim/closed_loop/process_factory.hpp"
#include "vehicle_sim/closed_loop/run_diary.hpp"
#include "vehicle_sim/closed_loop/run_monitor.hpp"

namespace hlc::closed_loop {

struct FaultRunSettings {
  LabSettings lab;
  std::vector<Fault> faults;
  /// Real time: duration of the run after the last fault; longer than PlanningCheck::kPatience.
  Nanoseconds calm{6 * kNanosecondsPerSecond};
  /// Real time: of the interruption, instead of after the calm; faults may last beyond it.
  std::optional<Nanoseconds> interrupt_at{};
  /// Real time: after the interruption and the last fault all have left: vehicles brake for a
  /// second; a vehicle without lab control stays for kVehicleStays after the lease.
  Nanoseconds leave_time{10 * kNanosecondsPerSecond};
  bool keeps_records{};  ///< FaultRunResult::records
};

/// A whole run of the scenario with faults, in memory: the machines of all its processes, each with
/// clocks of its own, connected by a simulated network.
/// Real time: faults happen, from before the start on; the calm; then the lab control is
/// interrupted, and all must leave. A death does not end the run (OnDeath::kContinue). Logical
/// time: a run of some steps, or fewer if a process dies.
///
/// A killed process is restarted at the end of the fault, a vehicle at its last pose.
/// @param diary  of the run; none: nullptr
/// @throws std::invalid_argument where the machines do
[[nodiscard]] FaultRunResult run_with_faults(const scenario::Scenario& scenario,
                                             const FaultRunSettings& settings,
                                             const Trace& trace = {}, RunDiary* diary = nullptr);

}  // namespace hlc::closed_loop
