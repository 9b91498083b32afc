#pragma once

#include <functional>
#include <vector>

#include "hlc_bridge/time/stop_signals.hpp"

namespace hlc::apps {

/// Runs one process, and returns its exit code. @param signals  of that process alone
using RunOne = std::function<int(int id, time::StopSignals& signals)>;

/// Runs `run(id)` in a process of its own for every id, as if each had been started alone: a
/// failure of one does not affect the others. The processes end with this process; SIGINT and
/// SIGTERM are forwarded to them. With one id `run` is called in this process.
///
/// @param run  handles the stop signals itself
/// @return the largest exit code; kExitDied for a process that a signal ended
/// @throws std::system_error if a process cannot be started
/// @pre this process has one thread: the new ones begin with a copy of it
[[nodiscard]] int process_per_vehicle(const std::vector<int>& ids, time::StopSignals& signals,
                                      const RunOne& run);

}  // namespace hlc::apps
