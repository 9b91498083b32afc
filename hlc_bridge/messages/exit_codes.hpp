#pragma once

/// Exit codes of the processes of a run.
namespace hlc {

inline constexpr int kExitGood = 0;
inline constexpr int kExitNotWritten = 1;  ///< good, but something asked for was not written
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitMissing = 3;  ///< somebody did not appear in time
inline constexpr int kExitDied = 4;     ///< somebody died during the run, or this process failed
inline constexpr int kExitDrivenBadly = 5;  ///< see driving_fault in driving_fault.hpp
inline constexpr int kExitInterrupted = 130;

}  // namespace hlc
