#include "hlc_bridge/record/report_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "planner/common/text_file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Of what takes a CSV file apart, among others.
std::string random_name(std::mt19937_64& random) {
  const std::string letters = "aB ,;\"\n\r'";
  std::string name;
  for (std::uint64_t i = random() % 12; i > 0; --i) name += letters[random() % letters.size()];
  return name;
}

ReportRecord random_record(std::mt19937_64& random, std::uint64_t step, std::uint8_t id) {
  std::uniform_real_distribution<double> value{-10.0, 10.0};
  ReportRecord record;
  coordination::Report& report = record.report;
  report.step = StepIndex{step};
  report.vehicle = VehicleId{id};
  report.status = static_cast<coordination::StepStatus>(random() % 4);
  report.reason = static_cast<coordination::FallbackReason>(random() % 10);
  report.planned_pose = {value(random), value(random), value(random)};
  report.planned_trim = TrimId{random() % 12};
  report.maneuver = random_name(random);
  report.subgraph = random_name(random);
  report.cost_m2 = value(random);
  report.quality = static_cast<coordination::PlanQuality>(random() % 3);
  report.gap_m2 = value(random);
  if (random() % 2 == 0) report.bound_m2 = value(random);
  report.generated = random();
  report.expanded = random() % 1000;
  report.level = static_cast<std::uint32_t>(random());
  for (std::uint64_t i = random() % 3; i > 0; --i) {
    report.coupled.push_back(VehicleId{static_cast<std::uint8_t>(random())});
    report.missing.push_back(VehicleId{static_cast<std::uint8_t>(random())});
  }
  report.deviation_m = value(random);
  if (random() % 2 == 0) {
    report.waiting = {.vehicles = {VehicleId{7}, VehicleId{static_cast<std::uint8_t>(random())}},
                      .since = StepIndex{random() % (step + 1)}};
  }
  for (std::uint64_t i = random() % 3; i > 0; --i) {
    report.blocked_by.push_back(VehicleId{static_cast<std::uint8_t>(random())});
  }
  for (std::uint64_t i = random() % 4; i > 0; --i) {
    report.plan.push_back({.to = {random() % 100}, .label = i == 2 ? "a;\\\"b,:" : "J2"});
  }
  if (random() % 2 == 0) {
    report.held = {.route = static_cast<std::uint32_t>(random()), .place_m = 0.1, .ahead_m = 1e-3};
  }
  if (random() % 2 == 0) report.arrived_since = StepIndex{random() % (step + 1)};
  record.planning_ns = random();
  record.deadline_missed = random() % 2 == 0;
  record.late_ns = random();
  record.response_ns = random();
  return record;
}

void expect_equal(const ReportRecord& a, const ReportRecord& b) {
  EXPECT_EQ(a.report.step, b.report.step);
  EXPECT_EQ(a.report.vehicle, b.report.vehicle);
  EXPECT_EQ(a.report.status, b.report.status);
  EXPECT_EQ(a.report.reason, b.report.reason);
  EXPECT_EQ(a.report.planned_pose, b.report.planned_pose);
  EXPECT_EQ(a.report.planned_trim, b.report.planned_trim);
  EXPECT_EQ(a.report.maneuver, b.report.maneuver);
  EXPECT_EQ(a.report.subgraph, b.report.subgraph);
  EXPECT_EQ(a.report.cost_m2, b.report.cost_m2);
  EXPECT_EQ(a.report.quality, b.report.quality);
  EXPECT_EQ(a.report.gap_m2, b.report.gap_m2);
  EXPECT_EQ(a.report.bound_m2, b.report.bound_m2);
  EXPECT_EQ(a.report.generated, b.report.generated);
  EXPECT_EQ(a.report.expanded, b.report.expanded);
  EXPECT_EQ(a.report.level, b.report.level);
  EXPECT_EQ(a.report.coupled, b.report.coupled);
  EXPECT_EQ(a.report.missing, b.report.missing);
  EXPECT_EQ(a.report.deviation_m, b.report.deviation_m);
  EXPECT_EQ(a.report.waiting, b.report.waiting);
  EXPECT_EQ(a.report.arrived_since, b.report.arrived_since);
  EXPECT_EQ(a.report.blocked_by, b.report.blocked_by);
  EXPECT_EQ(a.report.plan, b.report.plan);
  EXPECT_EQ(a.report.held, b.report.held);
  EXPECT_EQ(a.planning_ns, b.planning_ns);
  EXPECT_EQ(a.deadline_missed, b.deadline_missed);
  EXPECT_EQ(a.late_ns, b.late_ns);
  EXPECT_EQ(a.response_ns, b.response_ns);
}

const auto kUnexpected = [](const std::string& line) { ADD_FAILURE() << line; };

TEST(ReportFile, ReadsBackEveryFieldAndSortsAtTheEnd) {
  const unsigned seed = 23;
  SCOPED_TRACE(seed);
  std::mt19937_64 random{seed};
  const test::TemporaryFolder folder;
  std::vector<ReportRecord> sorted;
  for (std::uint64_t step = 0; step < 30; ++step) {
    for (std::uint8_t id = 1; id <= 3; ++id) {
      sorted.push_back(random_record(random, step, id));
    }
  }
  std::vector<ReportRecord> arriving = sorted;
  std::shuffle(arriving.begin(), arriving.end(), random);

  ReportFile file{folder / "reports.csv", kUnexpected};
  for (std::size_t i = 0; i < arriving.size(); ++i) {
    file.append(arriving[i]);
    // As if the program died now: everything so far is there.
    ASSERT_EQ(read_reports(folder / "reports.csv").size(), i + 1);
  }
  expect_equal(read_reports(folder / "reports.csv").back(), arriving.back());

  file.finish();
  const std::vector<ReportRecord> read = read_reports(folder / "reports.csv");
  ASSERT_EQ(read.size(), sorted.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    SCOPED_TRACE(i);
    expect_equal(read[i], sorted[i]);
  }
}

TEST(ReportFile, OfAReporterWithoutEndStaysInTheOrderOfArrivalAndIsNotKeptInMemory) {
  const test::TemporaryFolder folder;
  ReportFile file{folder / "reports.csv", kUnexpected};
  std::mt19937_64 random{1};
  ReportRecord record = random_record(random, 0, 1);
  record.report.maneuver = std::string(60'000, 'm');
  const std::size_t count = ReportFile::kMostKept / 60'000 + 1;
  for (std::size_t i = 0; i < count; ++i) {
    record.report.step = {count - i};
    file.append(record);
  }
  EXPECT_EQ(file.finish(), std::nullopt);
  const std::vector<ReportRecord> read = read_reports(folder / "reports.csv");
  ASSERT_EQ(read.size(), count);
  EXPECT_EQ(read.front().report.step.value, count);
}

TEST(ReportFile, RefusesWhatCannotBeAndSaysWhatCan) {
  const test::TemporaryFolder folder;
  ReportFile file{folder / "reports.csv", kUnexpected};
  std::mt19937_64 random{1};
  ReportRecord record = random_record(random, 1, 2);
  record.report.status = coordination::StepStatus::kPlanned;
  record.report.quality = coordination::PlanQuality::kOptimal;
  record.report.coupled = {VehicleId{3}};
  record.report.missing = {};
  file.append(record);
  const std::string good = read_file(folder / "reports.csv");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    bad.replace(bad.find(from, bad.find('\n')), from.size(), to);
    test::put(folder / "bad.csv", bad);
    return [&] { (void)read_reports(folder / "bad.csv"); };
  };
  EXPECT_THAT(with(",planned,", ",flying,"),
              ThrowsMessage<std::runtime_error>(HasSubstr(
                  "bad.csv:2: status = \"flying\", must be one of standby, planned, fallback")));
  EXPECT_THAT(with(",optimal,", ",good,"),
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("quality = \"good\", must be one of none, optimal, budget")));
  EXPECT_THAT(with("1,2,", "1,256,"),
              ThrowsMessage<std::runtime_error>(HasSubstr("id = \"256\", must be in 0 ... 255")));
  EXPECT_THAT(with(",3,,", ",3;x,,"),
              ThrowsMessage<std::runtime_error>(HasSubstr("coupled = \"3;x\"")));
  EXPECT_THAT(with(",3,,", ",300,,"),
              ThrowsMessage<std::runtime_error>(HasSubstr("coupled = \"300\"")));
}

TEST(ReportFile, WhatCouldNotBeAppendedIsInTheSortedFileIfThatIsWritten) {
  const test::TemporaryFolder folder;
  std::vector<std::string> failures;
  const auto note = [&](const std::string& line) { failures.push_back(line); };
  ReportFile file{folder / "reports.csv", note};
  {
    const test::FullDisk disk(1);
    file.append({});
    file.append({});
  }
  EXPECT_THAT(failures, testing::ElementsAre(HasSubstr("reports.csv: no longer written: File")));
  EXPECT_EQ(file.finish(), std::nullopt);
  EXPECT_EQ(read_reports(folder / "reports.csv").size(), 2U);
}

TEST(ReportFile, ThatItsFolderIsRemovedIsReportedOnceAndAtTheEnd) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run");
  std::vector<std::string> failures;
  const auto note = [&](const std::string& line) { failures.push_back(line); };
  ReportFile file{folder / "run" / "reports.csv", note};
  std::filesystem::remove_all(folder / "run");
  file.append({});
  file.append({});
  EXPECT_THAT(failures, testing::ElementsAre(HasSubstr("reports.csv: no longer written: No such")));
  EXPECT_THAT(file.finish(),
              testing::Optional(HasSubstr("reports.csv: incomplete, 2 rows are missing")));
  EXPECT_EQ(failures.size(), 1U);
}

TEST(ReportFile, FolderThatIsNotThereIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { ReportFile(folder / "no" / "reports.csv", kUnexpected); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no/reports.csv: cannot be written")));
}

}  // namespace
}  // namespace hlc::record
