#pragma once

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <exception>
#include <functional>
#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/time/exit_watchdog.hpp"
#include "hlc_bridge/time/stop_signals.hpp"

namespace hlc::apps {

/// For writing what is left of the outputs: at most 64 MiB of messages.
inline constexpr std::chrono::seconds kFinishTime{10};

/// main of a process of a run, once its flags are parsed; returns main's exit code.
///
/// `make` reads the input and makes the process (a shared_ptr to something with `int run()`); an
/// exception from it is invalid input, kExitBadInput. SIGINT and SIGTERM call `stop(process)`. An
/// exception from the run is a failure of this process: for the others it has died, kExitDied.
/// Either is logged in one line.
///
/// `finish(exit_code)` writes what is left of the outputs after the run and returns the exit code
/// with that. It has kFinishTime, and what follows it kTakeDownTime: a process that hangs then is
/// ended with the exit code that it has by then.
template <class Make, class Stop, class Finish = std::identity>
int run_program(const std::string& name, time::StopSignals& signals, Make make, Stop stop,
                Finish finish = {}) {
  decltype(make()) process;
  try {
    process = make();
  } catch (const std::exception& error) {
    spdlog::error(fmt::format("{}: {}", name, error.what()));
    return kExitBadInput;
  }
  // Shared with the signals' thread, which outlives this function.
  signals.on_stop([process, stop](int) { stop(*process); });
  int exit_code = kExitDied;
  try {
    exit_code = process->run();
  } catch (const std::exception& error) {
    spdlog::error(fmt::format("{}: failed during the run: {}", name, error.what()));
  }
  time::end_within(kFinishTime, exit_code_with_outputs(exit_code, false));
  exit_code = finish(exit_code);
  time::end_within(time::kTakeDownTime, exit_code);
  return exit_code;
}

}  // namespace hlc::apps
