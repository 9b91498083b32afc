// Peers and strangers that publish 10 000 messages a second, to a run with real processes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <ranges>
#include <string>
#include <thread>
#include <vector>

#include "tests/integration/flooder.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostMegabytes = 200;
constexpr std::size_t kLong = 60'000;  // in one datagram
/// Promised are 2 s; the rest is for a machine with other work.
constexpr std::chrono::seconds kMostUntilTheEnd{5};

/// VmHWM since `reset_peak`; 0 of a process that has ended.
std::size_t peak_megabytes(pid_t pid) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) / 1000;
  }
  return 0;
}

void reset_peak(pid_t pid) { std::ofstream(fmt::format("/proc/{}/clear_refs", pid)) << "5"; }

/// What a process answers by storing something is published for longer.
std::chrono::milliseconds duration_of(const Flood& flood) {
  const bool is_stored = flood.topic == "hlc/report" || flood.topic == "hlc/automaton_request";
  return is_stored ? 3000ms : 300ms * static_cast<int>(num_seeds(1));
}

std::vector<std::size_t> sizes() {
  if (num_seeds(1) == 1) return {kLong};
  return {100, kLong, 1'000'000};
}

class Flooded : public testing::Test {
 protected:
  void SetUp() override {
    lab_.start_all();
    ASSERT_TRUE(eventually(60s, [&] { return reports_so_far(lab_.folder()).size() > 10; }));
  }

  /// A line of the table.
  void expect_bounded(const Flood& flood, const std::string& publisher, std::size_t bytes) {
    const pid_t pid = lab_[flood.reader].pid();
    reset_peak(pid);
    const auto duration = duration_of(flood);
    const Flooder flooder(flood, publisher, bytes);
    ASSERT_TRUE(eventually(60s, [&] { return flooder.num_published() > 0; })) << flood.topic;
    const std::uint64_t before = flooder.num_published();
    std::this_thread::sleep_for(duration);
    const std::uint64_t each_second =
        (flooder.num_published() - before) * 1000 / static_cast<std::uint64_t>(duration.count());
    const std::size_t megabytes = peak_megabytes(pid);
    fmt::print("{:24} {:32} {:24} {:8} bytes {:6}/s {:5} MB\n", flood.reader, flood.topic,
               publisher, bytes, each_second, megabytes);
    EXPECT_LT(megabytes, kMostMegabytes) << flood.topic << " of " << publisher;
    ASSERT_EQ(lab_[flood.reader].wait_for(0ms), std::nullopt) << lab_.log(flood.reader);
  }

  /// While the last of its topics is flooded.
  void expect_end_at_signal(const std::string& process) {
    const auto of_process = [&](const Flood& flood) { return flood.reader == process; };
    const auto all = floods(lab_.lab_domain());
    const auto last = std::ranges::find_if(all | std::views::reverse, of_process);
    const Flooder flooder(*last, last->peer, kLong);
    ASSERT_TRUE(eventually(60s, [&] { return flooder.num_published() > 1000; }));
    const auto begin = std::chrono::steady_clock::now();
    lab_[process].send(SIGTERM);
    EXPECT_NE(lab_[process].wait_for(60s), std::nullopt) << process;
    const auto time = std::chrono::steady_clock::now() - begin;
    fmt::print("{:24} ends {:.2f} s after SIGTERM\n", process,
               std::chrono::duration<double>(time).count());
    EXPECT_LT(time, kMostUntilTheEnd) << process;
  }

  LabProcesses lab_{{.scenario = "circle",
                     .cars = 2,
                     .steps = 10'000,
                     .simulated_time = false,
                     .lab_control_flags = {"--on_death=continue"}}};
};

// Reports took 2.6 GB of the lab control in 12 s, and requests for subgraphs 40 MB a second of a
// controller.
TEST_F(Flooded, ProcessesStayBelow200MegabytesAndEndAtASignal) {
  for (const Flood& flood : floods(lab_.lab_domain())) {
    for (const std::size_t bytes : sizes()) {
      ASSERT_NO_FATAL_FAILURE(expect_bounded(flood, "stranger", bytes));
      ASSERT_NO_FATAL_FAILURE(expect_bounded(flood, flood.peer, bytes));
    }
  }
  for (const std::string& name : lab_.names()) {
    EXPECT_LT(peak_megabytes(lab_[name].pid()), kMostMegabytes) << name;
  }
  for (const char* process :
       {"high_level_controller_1", "middleware_1", "vehicle_1", "lab_control"}) {
    expect_end_at_signal(process);
  }
}

}  // namespace
}  // namespace hlc::test
