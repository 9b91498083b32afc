#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fault_plan.hpp"
#include "vehicle_sim/closed_loop/invariants.hpp"
#include "vehicle_sim/closed_loop/topics.hpp"

namespace hlc::closed_loop {

struct FaultRunSettings {
  /// Delays, clocks and starts of the processes; not the faults.
  std::uint64_t seed{};
  bool is_logical{};
  Transport transport{};
  std::vector<Fault> faults;
  /// Real time: the run goes on for so long after the last fault; longer than
  /// PlanningCheck::kPatience.
  Nanoseconds calm{6 * kNanosecondsPerSecond};
  std::uint64_t steps{100};  ///< logical time: of the run
};

struct FaultRunResult {
  Violations violations;
  std::uint64_t hash{};       ///< of all that was reported, driven and logged, and when
  std::uint64_t car_steps{};  ///< control steps that were reported
  std::uint64_t planned{};    ///< of them with a new plan
  std::uint64_t events{};
  double smallest_distance_m{};  ///< between driven footprints
};

/// A line for whoever looks on. @param at  true time since the begin of the run
using Trace = std::function<void(Nanoseconds at, const std::string& line)>;

/// A whole run of the scenario with faults, in memory: the machines of all its processes, each with
/// clocks of its own, connected by a simulated network.
///
///     lab_control, per vehicle: vehicle, middleware, controller
///
/// Real time: processes start within half a second; faults happen; the calm; then the lab control is
/// interrupted, and everybody must leave. A death does not end the run (OnDeath::kContinue). Logical
/// time: a run of `steps` steps, or less if somebody dies.
///
/// Nothing in a run depends on anything but scenario and settings: no thread, no clock, no address.
///
/// A process that is killed is started again by whoever killed it. One that ends by itself stays
/// away.
/// @throws std::invalid_argument where the machines do
[[nodiscard]] FaultRunResult run_with_faults(const Scenario& scenario,
                                             const FaultRunSettings& settings,
                                             const Trace& trace = {});

}  // namespace hlc::closed_loop
