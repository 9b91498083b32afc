#pragma once

/// Exit codes of the processes of a run.
namespace hlc {

inline constexpr int kExitGood = 0;
inline constexpr int kExitNotWritten = 1;  ///< good, but a requested output was not written
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitMissing = 3;  ///< a participant did not appear in time
inline constexpr int kExitDied = 4;     ///< a process died during the run, or this process failed
inline constexpr int kExitDrivenBadly = 5;  ///< see driving_fault in driving_fault.hpp
inline constexpr int kExitStuck = 6;        ///< driven to the end, but a vehicle was stuck then
inline constexpr int kExitInterrupted = 130;

/// Of a lab control: all steps were driven.
[[nodiscard]] constexpr bool is_driven_to_end(int exit_code) {
  return exit_code == kExitGood || exit_code == kExitStuck;
}

/// Of a process whose outputs are complete, or not: a failure of the run has precedence.
[[nodiscard]] constexpr int exit_code_with_outputs(int exit_code, bool are_complete) {
  return exit_code == kExitGood && !are_complete ? kExitNotWritten : exit_code;
}

}  // namespace hlc
