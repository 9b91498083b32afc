#include "hlc_bridge/record/explanation_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/common/text_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using result::Explanation;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

result::StepRecord row(std::uint64_t step, std::uint8_t vehicle) {
  result::StepRecord row{.step = step, .record = {}, .driven = {}};
  row.record.report.vehicle = VehicleId{vehicle};
  row.record.report.step = StepIndex{7 + step};
  row.record.report.status = coordination::StepStatus::kPlanned;
  return row;
}

/// Vehicle 2 waits in steps 1 and 2, and falls back in the latter; vehicle 3 misses others in 2.
std::vector<result::StepRecord> rows() {
  std::vector<result::StepRecord> rows;
  for (std::uint64_t step = 0; step < 4; ++step) {
    rows.push_back(row(step, 2));
    if (step == 1 || step == 2) rows.back().record.report.waiting.vehicles = {VehicleId{3}};
    if (step == 2) rows.back().record.report.status = coordination::StepStatus::kFallback;
    rows.push_back(row(step, 3));
    if (step >= 2) rows.back().record.report.missing = {VehicleId{2}};
  }
  return rows;
}

std::vector<Explanation> explanations() {
  std::vector<Explanation> explanations = result::steps_to_explain(rows());
  for (Explanation& one : explanations) one.text = "did   \"a, b\"\n      c\n";
  return explanations;
}

TEST(ExplanationFile, TheFirstStepOfEveryHindranceIsToBeExplained) {
  EXPECT_THAT(result::steps_to_explain(rows()),
              ElementsAre(Explanation{1, 2, VehicleId{2}, ""}, Explanation{2, 2, VehicleId{2}, ""},
                          Explanation{2, 3, VehicleId{3}, ""}));
  std::vector<result::StepRecord> before_start = rows();
  for (auto& one : before_start) {
    one.record.report.status = coordination::StepStatus::kStandby;
  }
  EXPECT_THAT(result::steps_to_explain(before_start), IsEmpty());
}

/// One vehicle with new plans, at these speeds at the begin of its steps.
std::vector<result::StepRecord> rows_at(const std::vector<double>& speeds_mps) {
  std::vector<result::StepRecord> rows;
  for (const double speed_mps : speeds_mps) {
    rows.push_back(row(rows.size(), 2));
    rows.back().driven_speed_mps = speed_mps;
  }
  return rows;
}

TEST(ExplanationFile, TheStepsWhosePlansBrakeToAStandAreToBeExplained) {
  // Decided in steps 2 and 3, driven from step 3 on; stands from step 5 to step 6.
  EXPECT_THAT(
      result::steps_to_explain(rows_at({0.8, 0.8, 0.805, 0.8, 0.4, 0.001, 0.0, 0.2, 0.8, 0.8})),
      ElementsAre(Explanation{2, 2, VehicleId{2}, ""}, Explanation{3, 6, VehicleId{2}, ""}));
  EXPECT_THAT(result::steps_to_explain(rows_at({0.0, 0.0, 0.4, 0.8, 0.4, 0.3})), IsEmpty())
      << "it stands before it drives, and only slows down later";
  EXPECT_THAT(result::steps_to_explain(rows_at({0.0, 0.03, 0.02, 0.03, 0.02})), IsEmpty())
      << "it never left";
  std::vector<result::StepRecord> waiting = rows_at({0.8, 0.8, 0.4, 0.0, 0.0});
  waiting[0].record.report.status = coordination::StepStatus::kFallback;
  waiting[3].record.report.waiting.vehicles = {VehicleId{3}};
  EXPECT_THAT(result::steps_to_explain(waiting),
              ElementsAre(Explanation{0, 0, VehicleId{2}, ""}, Explanation{1, 4, VehicleId{2}, ""},
                          Explanation{3, 3, VehicleId{2}, ""}))
      << "the fallback of step 0 does not brake by a new plan; the wait is explained by itself";
}

TEST(ExplanationFile, TextsOfSeveralLinesReadBack) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(read_explanations(folder.path(), rows()), IsEmpty()) << "without such a file";
  write_file(explanations_file(folder.path()), explanations_csv(explanations()));
  EXPECT_EQ(read_explanations(folder.path(), rows()), explanations());
}

TEST(ExplanationFile, OneThatIsBrokenOrOfAnotherRunIsRefusedWithFileAndLine) {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) -> std::string {
    write_file(explanations_file(folder.path()), text);
    try {
      static_cast<void>(read_explanations(folder.path(), rows()));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("step,text\n"), HasSubstr("explanations.csv:1: the heading must be"));
  EXPECT_THAT(refusal("step,vehicle,text\n1,2,a\n2,3,\"b\nc"),
              HasSubstr("explanations.csv:3: a quote that is not closed"));
  EXPECT_THAT(refusal("step,vehicle,text\n1,9,a\n"), HasSubstr(":2: vehicle = \"9\", must be"));
  EXPECT_THAT(refusal("step,vehicle,text\n1,2,a\n3,2,a\n"), HasSubstr(":3: step = \"3\", must be"));
  EXPECT_THAT(refusal("step,vehicle,text\nx,2,a\n"), HasSubstr(":2: step = \"x\", must be"));
}

}  // namespace
}  // namespace hlc::record
