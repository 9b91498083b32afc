#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vehicle_sim/closed_loop/fault_matrix.hpp"

namespace hlc::closed_loop {

/// Which output names the process that the fault is of.
enum class Naming : std::uint8_t {
  kNoEffect,  ///< nobody could see the fault: none is due
  kLog,       ///< a line of another process
  kReport,    ///< a report of another vehicle: its vehicle is missing, or one falls back for it
  /// Only the process itself, by its shell, which the simulator does not contain: it logs that its
  /// clock was set (tests/integration/clock_test.cpp), and goes on by its own.
  kByItself,
  kNone,  ///< the fault has an effect, and nothing names the process
};

/// What a run of a cell amounts to.
struct MatrixVerdict {
  /// Those of the run (RunMonitor), and of the checks `effect`, `exit codes`, `leftovers`, `blame`,
  /// `culprit` and `standstill` below.
  Violations problems;
  /// From the fault until all affected cars stand, for a second at least or to the end: the car of
  /// the process, of the lab control all. Of a fault in the phase `run`, before the run is stopped.
  /// None: one of them drives on, or none has departed (phase `start`).
  std::optional<double> standstill_s;
  double least_distance_m{};  ///< between driven footprints
  Naming naming{};
  std::string named_by;  ///< a line or report, for kLog and kReport
};

/// Checks of a run of a cell beside those of every run, against the undisturbed one:
///
/// * `exit codes`: of all others those of the undisturbed run. In logical time, where a death ends
///   the run, and without the lab control also kExitMissing and kExitDied; if the lab control ends
///   well, only of the processes of the same car. The process itself: as undisturbed, of one that
///   comes back to a run that is over, or did not receive its end, kExitMissing or kExitDied.
/// * `leftovers`: every process has ended, except one that is killed for good.
/// * `culprit`: where the fault has an effect, the process is named. An effect is: another exit
///   code of another process; a step that falls back because of a missing or neighbouring vehicle,
///   of a late message or a deviation; a minimal-risk stop; reports that end; a car that stands; a
///   start or an end that comes 3 s later (in logical time, by longer than all wait for a process).
///   What is logged and reported in the undisturbed run does not count.
/// * `blame`: the lab control does not take another process for dead that runs; in logical time,
///   where those that wait for the dead one do not answer either, its result lists it first. Not
///   checked of the lab control's own faults: separated from all, it takes all others for dead.
/// * `standstill`: if its controller or middleware is killed in real time, a car stands within
///   2.5 s (a plan of 1.6 s, agreed within 0.5 s), if the lab control is, within 7.5 s (a lease,
///   the step under way, the time until controllers leave, and the same).
///
/// @param before  the undisturbed run of the same setup and seed
[[nodiscard]] MatrixVerdict verdict_of(const MatrixCell& cell, const MatrixRun& run,
                                       const MatrixRun& before);

}  // namespace hlc::closed_loop
