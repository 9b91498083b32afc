#include "hlc_bridge/apps/run_program.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "hlc_bridge/time/signal.hpp"

namespace hlc::apps {
namespace {

using testing::ExitedWithCode;

struct FakeProcess {
  std::function<int()> run;
};

/// Ends the program as main would. In a child: the watchdog of the end stays behind.
[[noreturn]] void end_with(const std::function<std::shared_ptr<FakeProcess>()>& make) {
  time::StopSignals signals;
  spdlog::set_default_logger(spdlog::stderr_logger_mt("test"));  // a death test reads no other
  std::exit(run_program("blue", signals, make, [](FakeProcess&) {}));
}

[[noreturn]] void end_with_run(const std::function<int()>& run) {
  end_with([run] { return std::make_shared<FakeProcess>(run); });
}

class RunProgramDeathTest : public testing::Test {
 protected:
  RunProgramDeathTest() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(RunProgramDeathTest, TheProcesssExitCodeIsMains) {
  EXPECT_EXIT(end_with_run([] { return kExitMissing; }), ExitedWithCode(kExitMissing), "");
}

TEST_F(RunProgramDeathTest, WhatCannotBeMadeIsBadInput) {
  EXPECT_EXIT(end_with([]() -> std::shared_ptr<FakeProcess> {
                throw std::invalid_argument("--colour = grey, must be blue");
              }),
              ExitedWithCode(kExitBadInput), "blue: --colour = grey, must be blue");
}

TEST_F(RunProgramDeathTest, WhatFailsInTheRunIsNoBadInput) {
  EXPECT_EXIT(end_with_run([]() -> int { throw std::invalid_argument("the disk is full"); }),
              ExitedWithCode(kExitDied), "blue: failed during the run: the disk is full");
}

TEST_F(RunProgramDeathTest, AnIncompleteOutputIsInTheExitCodeOfAProcessThatHangsAtItsEnd) {
  const auto hang_at_the_end = [] {
    time::StopSignals signals;
    static_cast<void>(run_program(
        "blue", signals, [] { return std::make_shared<FakeProcess>([] { return kExitGood; }); },
        [](FakeProcess&) {},
        [](int exit_code) { return exit_code_with_outputs(exit_code, false); }));
    std::this_thread::sleep_for(std::chrono::minutes{1});  // hangs: to be ended long before
  };
  EXPECT_EXIT(hang_at_the_end(), ExitedWithCode(kExitNotWritten), "");
}

TEST_F(RunProgramDeathTest, ASignalStopsTheProcess) {
  const auto wait_for_stop = [] {
    time::StopSignals signals;
    time::Signal signal;
    bool stopped = false;
    const auto process = std::make_shared<FakeProcess>([&] {
      ::kill(::getpid(), SIGTERM);  // raise would send it to this thread alone
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes{1};
      return signal.wait_until(deadline, [&] { return stopped; }) ? 42 : 1;
    });
    std::_Exit(run_program(
        "blue", signals, [&] { return process; },
        [&](FakeProcess&) { signal.post([&] { stopped = true; }); }));
  };
  EXPECT_EXIT(wait_for_stop(), ExitedWithCode(42), "");
}

}  // namespace
}  // namespace hlc::apps
