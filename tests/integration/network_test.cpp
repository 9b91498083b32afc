// One machine per vehicle: three network namespaces, each with one vehicle's processes and a shared
// memory of its own, and a fourth with the lab control, joined by a bridge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_network.hpp"
#include "tests/integration/run_reports.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

constexpr int kVehicles = Network::kVehicles;

void expect_good_end(LabOverNetwork& lab) {
  EXPECT_THAT(lab.still_running_after(180s), testing::IsEmpty());
  for (const char* name : {"machine_1", "machine_2", "machine_3", "lab_control"}) {
    EXPECT_EQ(lab[name].wait_for(0ms), 0) << name << ": " << lab.log(name);
  }
}

/// Until `to` each car has driven only what it was driving half a second after the fault.
void expect_only_the_last_plans(const LabOverNetwork& lab, Nanoseconds fault, Nanoseconds to) {
  const Commands commands = lab.commands();
  const result::Drives drives = lab.drives();
  ASSERT_EQ(drives.size(), std::size_t{kVehicles});
  for (const auto& [id, drive] : drives) {
    expect_only_the_last_plan(drive, commands, id, fault, to, tracking_tolerance_m(lab.scenario()));
  }
}

// A car that is cut off receives nothing, and the others receive nothing from it: all three are
// affected.
TEST(OverNetwork, WhileAMachineIsCutOffForASecondOnlyTheLastPlansAreDrivenAndThenItIsTakenBack) {
  const Network network(true);
  if (!network.is_made()) GTEST_SKIP() << "network namespaces need root and iproute2";
  LabOverNetwork lab(network, 100);
  ASSERT_TRUE(eventually(120s, [&] { return planned_steps(lab.reports(), {2}) >= 15; }))
      << lab.log("lab_control") << lab.log("machine_2");
  const Nanoseconds before = time::real_time_now();
  network.cut_off(2);
  const Nanoseconds fault = time::real_time_now();
  // The fault lasts a second, with the time that the commands take.
  const Nanoseconds rest =
      before + kNanosecondsPerSecond - std::min(fault, before + kNanosecondsPerSecond);
  ::usleep(static_cast<useconds_t>(rest / 1000));
  const Nanoseconds joined = time::real_time_now();
  ASSERT_TRUE(network.join(2));
  const Nanoseconds after = time::real_time_now();
  EXPECT_THAT(lab.still_running_after(180s), testing::IsEmpty());
  expect_only_the_last_plans(lab, fault, joined);
  expect_nobody_was_touched(lab);
  // A process that is silent for 2 s is considered dead, and its last message may be 0.5 s older
  // than the cut.
  if (after > before + 1'400'000'000) {
    GTEST_SKIP() << "a busy machine made the cut last " << after - before << " ns: too long to be "
                 << "taken back";
  }
  expect_good_end(lab);

  // All noticed, and all receive each other's messages again. (In the last step some have left.)
  constexpr std::uint64_t kStepsOfTheFault = 5;
  std::map<std::uint8_t, StepIndex> missed_first;
  std::map<std::uint8_t, StepIndex> complete_last;
  for (const ReportRecord& record : lab.reports()) {
    const coordination::Report& report = record.report;
    if (report.status == coordination::StepStatus::kStandby) continue;
    const bool misses = report.vehicle.value == 2
                            ? is_among({1}, report.missing) && is_among({3}, report.missing)
                            : is_among({2}, report.missing);
    if (misses) missed_first.try_emplace(report.vehicle.value, report.step);
    if (report.missing.empty() && report.status == coordination::StepStatus::kPlanned) {
      complete_last[report.vehicle.value] = report.step;
    }
  }
  for (std::uint8_t id = 1; id <= kVehicles; ++id) {
    SCOPED_TRACE("vehicle " + std::to_string(id));
    ASSERT_TRUE(missed_first.contains(id));
    ASSERT_TRUE(complete_last.contains(id));
    EXPECT_GT(complete_last[id].value, missed_first[id].value + kStepsOfTheFault);
  }
}

TEST(OverNetwork, AMachineThatStaysCutOffLeavesEverybodyStanding) {
  const Network network(true);
  if (!network.is_made()) GTEST_SKIP() << "network namespaces need root and iproute2";
  LabOverNetwork lab(network, 400);
  ASSERT_TRUE(eventually(120s, [&] { return planned_steps(lab.reports(), {2}) >= 15; }))
      << lab.log("lab_control") << lab.log("machine_2");
  network.cut_off(2);
  const Nanoseconds fault = time::real_time_now();
  EXPECT_EQ(lab["lab_control"].wait_for(60s), 4) << lab.log("lab_control");
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  expect_only_the_last_plans(lab, fault, time::real_time_now());
  for (const auto& [id, drive] : lab.drives()) expect_stands_in_time(drive, id, fault);
  expect_nobody_was_touched(lab);
}

TEST(OverNetwork, MachinesFindEachOtherWithoutMulticast) {
  const Network network(false);
  if (!network.is_made()) GTEST_SKIP() << "network namespaces need root and iproute2";
  const TemporaryFolder folder;
  const std::string address = " --discovery_server_ip=" + Network::address(Network::kMachines);
  ChildProcess server(
      network.on(Network::kMachines,
                 test::build_folder() + "/bin/discovery_server --dds_domain=1" + address),
      folder / "server");
  LabOverNetwork lab(network, 20, " --discovery_mode=client" + address, true);
  expect_good_end(lab);
  for (std::uint8_t id = 1; id <= kVehicles; ++id) {
    EXPECT_GE(planned_steps(lab.reports(), {id}), 1U) << "vehicle " << int{id};
  }
  expect_nobody_was_touched(lab);
  server.send(SIGTERM);
  EXPECT_EQ(server.wait_for(60s), 0) << read_text(folder / "server");
}

}  // namespace
}  // namespace hlc::test
