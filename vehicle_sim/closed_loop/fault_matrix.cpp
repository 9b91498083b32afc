#include "vehicle_sim/closed_loop/fault_matrix.hpp"

#include <algorithm>
#include <utility>

#include "planner/scenario/starts.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kMillisecond = kNanosecondsPerMillisecond;
/// Real time: all drive from 2 to 3 s on; longer after the last fault of the phase `run` than
/// PlanningCheck::kPatience.
constexpr Nanoseconds kInterruption = 18 * kNanosecondsPerSecond;
/// Longer than the startup timeout: nobody drives without the process.
constexpr Nanoseconds kInterruptionOfNoStart = 36 * kNanosecondsPerSecond;
/// As on a terminal.
constexpr Nanoseconds kProgressPeriod = 100 * kMillisecond;
constexpr std::uint64_t kLogicalSteps = 60;
constexpr Nanoseconds kLasts = 3 * kNanosecondsPerSecond;
/// A process that comes back to a run that is over waits for its start until it times out.
constexpr Nanoseconds kTimeToLeave = 45 * kNanosecondsPerSecond;
constexpr std::int64_t kFlood_hz = 2000;

struct Window {
  Nanoseconds from{};
  Nanoseconds until{};
};

/// In which the fault of the process begins.
Window window_of(const MatrixCell& cell, const RunDiary& before, const std::string& process) {
  const RunDiary::Life& life = before.lives.at(process);
  const Nanoseconds drive = before.begin_of_drive.value();
  const Nanoseconds stop = before.stop.value();
  switch (cell.phase) {
    case MatrixPhase::kStart:
      return {.from = life.begin, .until = drive - 1};
    case MatrixPhase::kRun:
      return {.from = drive + (stop - drive) / 4, .until = drive + (stop - drive) / 2};
    case MatrixPhase::kStop:
      break;
  }
  // The first vehicle has received the request after one delay of the network.
  const Nanoseconds requested = stop - (cell.setup.is_logical ? 1 : 2) * kMillisecond;
  return {.from = requested, .until = std::max(life.end.value() - 1, requested)};
}

std::int64_t either_way(Nanoseconds amount, SeededRandom& random) {
  const auto set_by = static_cast<std::int64_t>(random.between(amount / 10, amount));
  return random.chance(0.5) ? set_by : -set_by;
}

std::vector<Fault> both_ways(Fault fault) {
  std::vector<Fault> faults{fault};
  std::swap(fault.process, fault.peer);
  faults.push_back(fault);
  return faults;
}

std::vector<Fault> faults_of(const MatrixCell& cell, Fault fault, SeededRandom& random) {
  const Nanoseconds lease = machine::run_time(cell.setup.is_logical).lease;
  const Nanoseconds around_lease = random.between(lease / 4, lease + 3 * lease / 4);
  fault.end = fault.begin + kLasts;
  switch (cell.fault) {
    case MatrixFault::kKill:
      fault.kind = FaultKind::kKill;
      fault.end = kForGood;
      return {fault};
    case MatrixFault::kRestart:
      fault.kind = FaultKind::kKill;
      fault.end = fault.begin + random.between(200 * kMillisecond, 3000 * kMillisecond);
      return {fault};
    case MatrixFault::kFreeze:
      fault.kind = FaultKind::kFreeze;
      fault.end = fault.begin + around_lease;
      return {fault};
    case MatrixFault::kCut:
      fault.kind = FaultKind::kCut;
      fault.end = fault.begin + around_lease;
      return both_ways(fault);
    case MatrixFault::kDelay:
      fault.kind = FaultKind::kDelay;
      fault.amount = 300 * kMillisecond;
      return both_ways(fault);
    case MatrixFault::kClockStep:
      fault.kind = FaultKind::kStep;
      fault.amount =
          either_way(cell.role == Role::kVehicle ? 2 * kMillisecond : 300 * kMillisecond, random);
      return {fault};
    case MatrixFault::kFlood:
      fault.kind = FaultKind::kFlood;
      fault.amount = kFlood_hz;
      return {fault};
    case MatrixFault::kFullDisk:
    case MatrixFault::kForged:
      break;
  }
  return {};
}

}  // namespace

FaultMatrix::FaultMatrix(const std::filesystem::path& scenario_folder)
    : scenario_(scenario::read_scenario({.file = scenario_folder / "paper_three_cars.yaml"})),
      prepared_(scenario::prepare_subgraph_of(scenario_)) {}

scenario::Scenario FaultMatrix::scenario_of(const MatrixSetup& setup, std::uint64_t seed) const {
  scenario::Scenario scenario = scenario::with_random_starts(scenario_, seed);
  scenario.rounds = setup.rounds;
  return scenario;
}

FaultRunSettings FaultMatrix::settings_of(const MatrixSetup& setup, std::uint64_t seed) const {
  return {.lab = {.seed = seed,
                  .is_logical = setup.is_logical,
                  .transport = setup.transport,
                  .steps = kLogicalSteps,
                  .progress_interval = kProgressPeriod,
                  .prepared = prepared_},
          .interrupt_at = kInterruption,
          .leave_time = kTimeToLeave};
}

MatrixRun FaultMatrix::undisturbed(const MatrixSetup& setup, std::uint64_t seed) const {
  MatrixRun run;
  run.result = run_with_faults(scenario_of(setup, seed), settings_of(setup, seed), {}, &run.diary);
  return run;
}

MatrixRun FaultMatrix::run(const MatrixCell& cell, std::uint64_t seed, const RunDiary& before,
                           const Trace& trace) const {
  SeededRandom random(
      mixed(mixed(seed, static_cast<std::uint64_t>(cell.role)),
            10 * static_cast<std::uint64_t>(cell.fault) + static_cast<std::uint64_t>(cell.phase)));
  const scenario::Scenario scenario = scenario_of(cell.setup, seed);
  const std::uint8_t car = scenario.vehicles[random.below(scenario.vehicles.size())].id.value;
  MatrixRun run;
  run.culprit = name_of({.role = cell.role, .vehicle = car});
  const Window window = window_of(cell, before, run.culprit);
  run.faults = faults_of(
      cell, {.begin = random.between(window.from, window.until), .process = run.culprit}, random);
  FaultRunSettings settings = settings_of(cell.setup, seed);
  settings.faults = run.faults;
  if (cell.fault == MatrixFault::kKill && cell.phase == MatrixPhase::kStart) {
    settings.interrupt_at = kInterruptionOfNoStart;
  }
  run.result = run_with_faults(scenario, settings, trace, &run.diary);
  return run;
}

}  // namespace hlc::closed_loop
