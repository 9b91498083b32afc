#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/policy/subgraph_selector.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/fork.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::closed_loop {

/// Clocks for measured times; without a clock they are 0. Nothing else depends on them.
struct Clocks {
  std::function<Nanoseconds()> wall{};  ///< WallTimes, RunFacts::wall_s
  /// Processor time of the calling thread, for the reports' planning times, so that the machine's
  /// other load does not count.
  std::function<Nanoseconds()> cpu{};
};

struct ExperimentOptions {
  std::uint64_t steps{150};
  /// Vehicle i measures with noise of seed noise_seed + i, as run_lab.sh has it; none: exactly.
  std::optional<std::uint64_t> noise_seed{};
  tracking::FollowerGains gains{};
  std::optional<simulated_vehicle::Stamps> stamps{};  ///< none: stamps_of the scenario
  Clocks clocks{};
  /// Disturbances of the controllers' steps. Default: no losses, no delays.
  controller::JointStepRules rules{};
  std::vector<Fork> forks{};  ///< @pre check_forks throws nothing
  /// prepare_subgraph_of the scenario, for who drives it more than once. None: made by the run.
  std::optional<controller::PreparedSubgraph> prepared{};
  /// Receives each controller at the end of its step, once its report is complete, with what chose
  /// its subgraph. May be absent.
  using AfterStep = std::function<void(
      const controller::Controller&, const policy::SubgraphSelector&, const coordination::Report&)>;
  AfterStep after_step{};
};

/// Wall time of a run by part. The rest of RunFacts::wall_s: state lists, commands, lab control,
/// this measurement.
struct WallTimes {
  double planning_s{};      ///< Controller::plan of all vehicles: poses the problem, searches
  double coordination_s{};  ///< the other phases of the controllers' steps
  double vehicles_s{};      ///< the simulated vehicles' ticks
};

/// The content of a run folder.
struct Experiment {
  result::RunFacts facts;
  std::vector<ReportRecord> reports;
  result::Drives drives;
  WallTimes wall;
  /// Processor time (Clocks::cpu) of each step of all controllers since the start, as the reports
  /// have them: from the state list to the commands and reports, without the simulated vehicles.
  std::vector<double> steps_s;
};

/// A whole run of the scenario in logical time within this process and thread: lab control
/// (LogicalRun), middlewares (StateBuffer, check_command), controllers (HlcCore) and vehicles
/// (SimulatedVehicle), the very step functions that the processes run. Messages are handed over in
/// memory instead of by DDS, all at once and none lost.
///
/// A run with processes in logical time gives bitwise identical poses (equal trace_sha256).
///
/// All middlewares receive the same, so one buffer represents all of theirs.
///
/// @pre the automaton's step is a multiple of the vehicles' tick (20 ms)
/// @throws std::invalid_argument with one line: maneuvers or a speed of a fork that the automaton
/// has no subgraph for (before the run begins); an obstacle in the way of a vehicle, or a route
/// that the vehicle does not fit (in the fork's step)
[[nodiscard]] Experiment drive_experiment(const scenario::Scenario& scenario,
                                          const ExperimentOptions& options);

}  // namespace hlc::closed_loop
