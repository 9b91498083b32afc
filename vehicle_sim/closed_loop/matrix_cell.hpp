#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/controller/controller_options.hpp"
#include "vehicle_sim/closed_loop/process_factory.hpp"
#include "vehicle_sim/closed_loop/topics.hpp"

/// The cells of the fault matrix: which faults of which processes, when, and in which runs.
namespace hlc::closed_loop {

enum class MatrixFault : std::uint8_t {
  kKill,       ///< for good
  kFreeze,     ///< suspended for 0.25 ... 1.75 leases
  kRestart,    ///< killed, and started again after 0.2 ... 3 s
  kCut,        ///< from all others, in both directions, for 0.25 ... 1.75 leases
  kDelay,      ///< messages to and from it take up to 300 ms longer, for 3 s
  kClockStep,  ///< its real-time clock is set by up to 300 ms, of a vehicle by up to 2 ms, for 3 s
  kFullDisk,   ///< nothing can be written
  kFlood,      ///< its messages are repeated 2000 times a second on every topic, for 3 s
  kForged,     ///< a stranger publishes in its name
};

/// When the fault begins.
enum class MatrixPhase : std::uint8_t {
  kStart,  ///< after the start of the process, before the first plan of any vehicle
  kRun,    ///< in the second quarter of the drive
  kStop,   ///< between the request to stop and the end of the process
};

struct MatrixSetup {
  bool is_logical{};
  Transport transport{};
  controller::Rounds rounds{};
};

/// One fault of one process, in one phase of a run.
struct MatrixCell {
  Role role{};
  MatrixFault fault{};
  MatrixPhase phase{};
  MatrixSetup setup{};
};

/// Real time with the endpoints of loopback and of the lab, and logical time; the simulator has no
/// logical time in the lab. Each with both ways of planning.
[[nodiscard]] std::vector<MatrixSetup> matrix_setups();
/// All roles x faults x phases x setups.
[[nodiscard]] std::vector<MatrixCell> matrix_cells();

[[nodiscard]] const char* to_string(Role role);
[[nodiscard]] const char* to_string(MatrixFault fault);
[[nodiscard]] const char* to_string(MatrixPhase phase);
/// "real time, lab, two rounds"
[[nodiscard]] std::string to_string(const MatrixSetup& setup);
/// "controller, kill, run: real time, lab, two rounds"
[[nodiscard]] std::string to_string(const MatrixCell& cell);

/// Why the simulator does not run a cell.
enum class NotRunReason : std::uint8_t {
  kNoMeaning,  ///< there is no such fault
  kOtherTest,  ///< it takes parts of the real processes; a test with them covers it
  kOpen,       ///< it takes them, and no test covers it
};
struct NotRun {
  NotRunReason reason{};
  std::string text;  ///< the name of the test, or why
};
[[nodiscard]] std::optional<NotRun> not_run(const MatrixCell& cell);

/// Why nothing names the process in some runs of a cell, though its fault has an effect: a known
/// weakness, which fails these runs; none: there is none.
[[nodiscard]] std::optional<std::string> known_weakness(const MatrixCell& cell);

}  // namespace hlc::closed_loop
