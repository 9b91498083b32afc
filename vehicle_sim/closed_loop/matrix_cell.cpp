#include "vehicle_sim/closed_loop/matrix_cell.hpp"

#include <array>

namespace hlc::closed_loop {
namespace {

constexpr std::array kRoles{Role::kController, Role::kVehicle, Role::kMiddleware,
                            Role::kLabControl};
constexpr std::array kFaults{MatrixFault::kKill,     MatrixFault::kFreeze, MatrixFault::kRestart,
                             MatrixFault::kCut,      MatrixFault::kDelay,  MatrixFault::kClockStep,
                             MatrixFault::kFullDisk, MatrixFault::kFlood,  MatrixFault::kForged};
constexpr std::array kPhases{MatrixPhase::kStart, MatrixPhase::kRun, MatrixPhase::kStop};

NotRun full_disk(MatrixPhase phase) {
  if (phase == MatrixPhase::kStart) {
    return {.reason = NotRunReason::kOpen, .text = "a disk that is full before the start"};
  }
  return {.reason = NotRunReason::kOtherTest, .text = "DiskThatGetsFull"};
}

/// On the lab's transport the rule is tested (`Sender`), but no run: a stranger counts there until
/// a process of the name is present.
NotRun forged(const MatrixSetup& setup) {
  if (setup.transport == Transport::kLab) {
    return {.reason = NotRunReason::kOpen, .text = "forged messages on the lab's transport"};
  }
  return {.reason = NotRunReason::kOtherTest, .text = "ForgedMessages"};
}

}  // namespace

std::vector<MatrixSetup> matrix_setups() {
  std::vector<MatrixSetup> setups;
  for (const controller::Rounds rounds :
       {controller::Rounds::kSequential, controller::Rounds::kTwo}) {
    setups.push_back({.transport = Transport::kLoopback, .rounds = rounds});
    setups.push_back({.transport = Transport::kLab, .rounds = rounds});
    setups.push_back({.is_logical = true, .transport = Transport::kLoopback, .rounds = rounds});
  }
  return setups;
}

std::vector<MatrixCell> matrix_cells() {
  std::vector<MatrixCell> cells;
  for (const Role role : kRoles) {
    for (const MatrixFault fault : kFaults) {
      for (const MatrixPhase phase : kPhases) {
        for (const MatrixSetup& setup : matrix_setups()) {
          cells.push_back({.role = role, .fault = fault, .phase = phase, .setup = setup});
        }
      }
    }
  }
  return cells;
}

const char* to_string(Role role) {
  switch (role) {
    case Role::kLabControl:
      return "lab control";
    case Role::kVehicle:
      return "vehicle";
    case Role::kMiddleware:
      return "middleware";
    case Role::kController:
      return "controller";
  }
  return "";
}

const char* to_string(MatrixFault fault) {
  switch (fault) {
    case MatrixFault::kKill:
      return "kill";
    case MatrixFault::kFreeze:
      return "freeze";
    case MatrixFault::kRestart:
      return "restart";
    case MatrixFault::kCut:
      return "cut";
    case MatrixFault::kDelay:
      return "delay";
    case MatrixFault::kClockStep:
      return "clock step";
    case MatrixFault::kFullDisk:
      return "full disk";
    case MatrixFault::kFlood:
      return "flood";
    case MatrixFault::kForged:
      return "forged";
  }
  return "";
}

const char* to_string(MatrixPhase phase) {
  switch (phase) {
    case MatrixPhase::kStart:
      return "start";
    case MatrixPhase::kRun:
      return "run";
    case MatrixPhase::kStop:
      return "stop";
  }
  return "";
}

std::string to_string(const MatrixSetup& setup) {
  return std::string(setup.is_logical ? "logical" : "real") + " time, " +
         (setup.transport == Transport::kLab ? "lab" : "loopback") + ", " +
         (setup.rounds == controller::Rounds::kTwo ? "two rounds" : "sequential");
}

std::string to_string(const MatrixCell& cell) {
  return std::string(to_string(cell.role)) + ", " + to_string(cell.fault) + ", " +
         to_string(cell.phase) + ": " + to_string(cell.setup);
}

std::optional<NotRun> not_run(const MatrixCell& cell) {
  if (cell.fault == MatrixFault::kClockStep && cell.setup.is_logical) {
    return NotRun{.reason = NotRunReason::kNoMeaning, .text = "no real-time clock is read"};
  }
  if (cell.fault == MatrixFault::kForged) return forged(cell.setup);
  if (cell.fault == MatrixFault::kFullDisk) return full_disk(cell.phase);
  return std::nullopt;
}

std::optional<std::string> known_weakness(const MatrixCell& cell) {
  if (cell.role == Role::kVehicle && cell.fault == MatrixFault::kDelay &&
      cell.phase == MatrixPhase::kStart && !cell.setup.is_logical) {
    return "the middleware waits for the controller, which does not log that states are late";
  }
  if (cell.role != Role::kLabControl) return std::nullopt;
  if (cell.fault == MatrixFault::kRestart && cell.phase == MatrixPhase::kStop &&
      cell.setup.is_logical) {
    return "vehicles that brake wait for the triggers of the next lab control until it times out";
  }
  if (cell.fault == MatrixFault::kDelay && cell.phase == MatrixPhase::kStart &&
      cell.setup.transport == Transport::kLab) {
    return "states that overtake each other look like those of vehicles that have not settled";
  }
  return std::nullopt;
}

}  // namespace hlc::closed_loop
