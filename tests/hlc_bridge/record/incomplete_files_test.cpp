#include "hlc_bridge/record/incomplete_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hlc_bridge/messages/exit_codes.hpp"

namespace hlc::record {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr Nanoseconds kTick = 20'000'000;
constexpr std::uint64_t kFirstStep = 7;
constexpr std::uint64_t kSteps = 30;

/// Two vehicles whose records reach the end of 30 steps of 0.2 s.
class IncompleteFiles : public testing::Test {
 protected:
  IncompleteFiles() {
    facts_.simulated_time = true;
    facts_.vehicle_ids = {1, 2};
    facts_.period = kPeriod;
    facts_.steps = kSteps;
    facts_.first_step = kFirstStep;
    for (std::uint64_t step = 0; step < kSteps; ++step) {
      for (const std::uint8_t id : facts_.vehicle_ids) {
        result::StepRecord row{.step = step, .record = {}, .driven = {}};
        row.record.report.vehicle = VehicleId{id};
        rows_.push_back(row);
      }
    }
    for (const std::uint8_t id : facts_.vehicle_ids) {
      for (Nanoseconds t = 0; t < (kFirstStep + kSteps) * kPeriod; t += kTick) {
        drives_[id].push_back({.t = t});
      }
    }
  }

  [[nodiscard]] std::vector<std::string> lines() const {
    return incomplete_files(facts_, rows_, drives_);
  }
  void cut_drive(std::uint8_t id, double until_s) {
    const auto until = kFirstStep * kPeriod + static_cast<Nanoseconds>(1e9 * until_s);
    std::erase_if(drives_[id], [&](const result::DrivenSample& one) { return one.t > until; });
  }
  void cut_reports(std::uint8_t id, std::uint64_t steps) {
    std::erase_if(rows_, [&](const result::StepRecord& row) {
      return row.record.report.vehicle == VehicleId{id} && row.step >= steps;
    });
  }

  result::RunFacts facts_;
  std::vector<result::StepRecord> rows_;
  result::Drives drives_;
};

TEST_F(IncompleteFiles, ARunWithWholeRecordsHasNone) { EXPECT_THAT(lines(), IsEmpty()); }

TEST_F(IncompleteFiles, ADriveThatIsCutOffIsNamedWithTheTimeOfItsEnd) {
  cut_drive(2, 2.5);
  EXPECT_THAT(lines(), ElementsAre("vehicle_2.csv ends early, at 2.50 s of 6.00 s: vehicle 2 is "
                                   "not compared with others after that"));
}

TEST_F(IncompleteFiles, ADriveThatIsMissingIsNamed) {
  drives_.erase(1);
  EXPECT_THAT(lines(), ElementsAre("vehicle_1.csv is missing: vehicle 1 has no driven values"));
}

TEST_F(IncompleteFiles, ReportsThatAreCutOffAreNamedWithTheStepOfTheirEnd) {
  cut_reports(1, 12);
  cut_reports(2, 11);
  EXPECT_THAT(lines(), ElementsAre("reports.csv ends early: 12 of 30 steps of vehicle 1, to 2.40 s "
                                   "of 6.00 s"));
}

TEST_F(IncompleteFiles, ReportsThatLackTheEndOfTheLastStepAreIncomplete) {
  cut_reports(2, kSteps - 1);
  EXPECT_THAT(lines(), ElementsAre("reports.csv ends early: 29 of 30 steps of vehicle 2, to 5.80 s "
                                   "of 6.00 s"));
  facts_.simulated_time = false;
  EXPECT_THAT(lines(), IsEmpty()) << "in real time a vehicle may leave a step unreported";
}

TEST_F(IncompleteFiles, ARunThatEndedEarlyIsAsLongAsItsReports) {
  facts_.exit_code = kExitDied;
  for (const std::uint8_t id : facts_.vehicle_ids) {
    cut_reports(id, 12);
    cut_drive(id, 2.3);
  }
  EXPECT_THAT(lines(), IsEmpty());
  cut_drive(2, 1.0);
  EXPECT_THAT(lines(), ElementsAre("vehicle_2.csv ends early, at 1.00 s of 2.20 s: vehicle 2 is "
                                   "not compared with others after that"));
}

TEST_F(IncompleteFiles, ARunThatDidNotStartHasNone) {
  facts_.first_step.reset();
  rows_.clear();
  EXPECT_THAT(lines(), IsEmpty());
}

}  // namespace
}  // namespace hlc::record
