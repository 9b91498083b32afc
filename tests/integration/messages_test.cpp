// The recording of all messages (run.mcap) of runs with real processes, and records that cannot be
// written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <map>
#include <set>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "planner/common/text_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/hlc_bridge/mcap/mcap_reader.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

/// Vehicle and step of reports.
using Reports = std::multiset<std::pair<int, std::uint64_t>>;

Reports reports_in(const std::vector<McapMessage>& messages) {
  Reports reports;
  for (const McapMessage& message : messages) {
    if (message.type != "hlc::ReportMessage") continue;
    // Its first two members; the second is aligned after the encapsulation header of 4 bytes.
    std::uint64_t step = 0;
    std::memcpy(&step, message.payload.data() + 12, sizeof step);
    reports.emplace(static_cast<unsigned char>(message.payload.at(4)), step);
  }
  return reports;
}

Reports reports_in(const std::filesystem::path& run_folder) {
  Reports reports;
  for (const ReportRecord& record : reports_so_far(run_folder)) {
    reports.emplace(record.report.vehicle.value, record.report.step.value);
  }
  return reports;
}

TEST(Messages, OfEveryProcessAreRecordedAndTheRunIsTheSame) {
  LabProcesses recorded({.records_messages = true});
  LabProcesses plain({});
  const std::string trace = trace_of(recorded);
  EXPECT_EQ(trace, trace_of(plain));
  EXPECT_NE(trace, "");
  EXPECT_FALSE(std::filesystem::exists(plain.folder() / "run.mcap"));

  const std::vector<McapMessage> messages = read_by_index(recorded.folder() / "run.mcap");
  EXPECT_EQ(reports_in(messages), reports_in(recorded.folder()));
  std::set<std::string> publishers;
  std::map<std::string, std::vector<std::uint64_t>> ticks;
  for (const McapMessage& message : messages) {
    if (message.metadata.contains("publisher")) publishers.insert(message.metadata.at("publisher"));
    if (message.type == "VehicleState") ticks[message.topic].push_back(message.log_time);
  }
  const auto map = std::ranges::find(messages, "scene/map", &McapMessage::topic);
  ASSERT_NE(map, messages.end());
  EXPECT_EQ(map->log_time, messages.front().log_time);
  EXPECT_EQ(publishers.size(), recorded.names().size()) << testing::PrintToString(publishers);
  EXPECT_EQ(ticks.size(), 3U);
  for (const auto& [topic, times] : ticks) {
    EXPECT_TRUE(std::ranges::is_sorted(times)) << topic;
    EXPECT_GE(times.back(), 25 * 200'000'000U) << topic;  // the last step's begin
  }
  EXPECT_FALSE(std::filesystem::exists(recorded.folder() / "messages"));
}

/// Whether every phase of every step ended because all had answered, long before its deadline: then
/// nothing that was published arrived too late.
bool is_undisturbed(const std::vector<ReportRecord>& reports) {
  return std::ranges::all_of(reports, [](const ReportRecord& record) {
    return record.report.reason == coordination::FallbackReason::kNone &&
           record.report.missing.empty() && record.response_ns < 30'000'000;
  });
}

/// As run_lab.sh keeps it.
void keep_configuration(const std::filesystem::path& run_folder) {
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
  record::keep_configuration(run_folder, scenario::files_of(scenario));
  write_file(run_folder / "configuration" / "flags.yaml",
             record::flags_yaml({.file = scenario.file}) + "noise_seed: null\n");
}

TEST(Messages, OfARunInRealTimeLetItBeDrivenAgain) {
  LabProcesses lab({.simulated_time = false, .records_messages = true});
  keep_configuration(lab.folder());
  lab.start_all();
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  static_cast<void>(lab.summarize());  // it may have a late step, on a busy machine
  const Outcome again = run_program("replay " + lab.folder().string());
  for (const char* vehicle : {"vehicle 1", "vehicle 2", "vehicle 3"}) {
    EXPECT_THAT(again.output, testing::HasSubstr(vehicle));
  }
  if (is_undisturbed(reports_so_far(lab.folder()))) {
    EXPECT_EQ(again.exit_code, 0) << again.output;
  } else {
    EXPECT_LE(again.exit_code, 1) << again.output;
  }
}

TEST(Messages, OfProcessesThatAreKilledAreReadableUpToTheLastSecond) {
  LabProcesses lab({.steps = 1000, .simulated_time = false, .records_messages = true});
  lab.start_all();
  ASSERT_TRUE(eventually(60s, [&] { return reports_so_far(lab.folder()).size() > 60; }));
  for (const std::string& name : lab.names()) lab[name].send(SIGKILL);
  EXPECT_THAT(lab.still_running_after(60s), testing::IsEmpty());
  static_cast<void>(lab.summarize());
  const Reports recorded = reports_in(read_by_index(lab.folder() / "run.mcap"));
  Reports expected = reports_in(lab.folder());
  std::uint64_t last = 0;
  for (const auto& [vehicle, step] : expected) last = std::max(last, step);
  std::erase_if(expected, [last](const auto& report) { return report.second + 5 > last; });
  EXPECT_GT(expected.size(), 20U);
  EXPECT_TRUE(std::ranges::includes(recorded, expected));
  EXPECT_TRUE(std::filesystem::exists(lab.folder() / "messages/lab_control.mcap"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

class DiskThatGetsFull : public testing::TestWithParam<bool> {};  // logical time

/// The cars drive as ever: only what is recorded of it ends early.
TEST_P(DiskThatGetsFull, EndsNoProcess) {
  constexpr rlim_t kBytes = 8192;  // the logs are shorter, and what lab control publishes
  LabProcesses lab({.simulated_time = GetParam(), .records_messages = true});
  {
    const FullDisk disk(kBytes);
    lab.start_all();
  }
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  for (const std::string& name : lab.names()) {
    const std::string log = lab.log(name);
    SCOPED_TRACE(name + ": " + log);
    EXPECT_EQ(lab[name].wait_for(1ms), kExitNotWritten);
    // Of the lab control reports and certificates, of a vehicle its drive.
    const std::size_t num_tables = name == "lab_control" ? 2 : name.starts_with("vehicle") ? 1 : 0;
    EXPECT_EQ(count_of(log, ".csv: no longer written: File too large"), num_tables);
    EXPECT_EQ(count_of(log, ".csv: incomplete, "), num_tables);
    const bool has_few_messages = name == "lab_control";
    EXPECT_EQ(count_of(log, ".mcap: no longer written: File too large"),
              has_few_messages ? 0U : 1U);
    EXPECT_EQ(count_of(log, ".mcap: incomplete"), has_few_messages ? 0U : 1U);
  }
  EXPECT_EQ(record::read_facts(lab.folder() / "run.json").exit_code, kExitGood);
  EXPECT_THAT(lab.log("lab_control"), testing::HasSubstr("25 steps driven"));
}

INSTANTIATE_TEST_SUITE_P(Times, DiskThatGetsFull, testing::Bool(), [](const auto& tested) {
  return tested.param ? "LogicalTime" : "RealTime";
});

}  // namespace
}  // namespace hlc::test
