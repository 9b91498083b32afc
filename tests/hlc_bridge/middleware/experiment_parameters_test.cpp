#include "hlc_bridge/middleware/experiment_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

namespace hlc::middleware {
namespace {

using test::kPeriod;
using test::run_parameters;
using testing::HasSubstr;

const std::vector<std::uint8_t> kVehicles{1, 2};

TEST(ExperimentParameters, MustHoldItsVehiclesOnceAndInRange) {
  EXPECT_EQ(validate(run_parameters(200, {1, 2}), kVehicles, kListOffset), "");
  EXPECT_EQ(validate(run_parameters(200, {255, 2, 7, 1}), kVehicles, kListOffset), "");
  for (const std::vector<std::int32_t>& wrong :
       {std::vector<std::int32_t>{1}, {1, 2, 2}, {0, 1, 2}, {1, 2, 256}, {}}) {
    EXPECT_THAT(validate(run_parameters(200, wrong), kVehicles, kListOffset),
                HasSubstr("must be in 1 ... 255 and hold --vehicle_ids = 1, 2 once"));
  }
}

TEST(ExperimentParameters, PeriodMustBeMoreThanTheOffset) {
  EXPECT_EQ(validate(run_parameters(0, {1, 2}), kVehicles, kListOffset),
            "middleware_period_ms = 0 ms, must be more than --offset_nanoseconds = 1");
  EXPECT_NE(validate(run_parameters(200, {1, 2}), kVehicles, kPeriod), "");
  EXPECT_EQ(validate(run_parameters(200, {1, 2}), kVehicles, kPeriod - 1), "");
}

class NextExperimentTest : public testing::Test {
 protected:
  void answer(std::uint64_t period_ms, const std::vector<std::int32_t>& active_ids) {
    next_.take({.name = kPeriodParameter, .value = period_ms});
    next_.take({.name = kActiveIdsParameter, .value = active_ids});
  }
  NextExperiment::Outcome evaluate() { return next_.evaluate(kVehicles, kListOffset, kPeriod); }

  NextExperiment next_;
};

TEST_F(NextExperimentTest, IsAskedForEverySecond) {
  next_.begin();
  constexpr Nanoseconds kStart = 100 * kNanosecondsPerSecond;
  EXPECT_TRUE(next_.request_is_due(kStart));
  EXPECT_FALSE(next_.request_is_due(kStart + NextExperiment::kRequestInterval - 1));
  EXPECT_TRUE(next_.request_is_due(kStart + NextExperiment::kRequestInterval));
}

TEST_F(NextExperimentTest, IsKnownOnceBothAnswersFit) {
  next_.begin();
  ASSERT_TRUE(next_.request_is_due(1));
  next_.take({.name = kPeriodParameter, .value = std::uint64_t{200}});
  EXPECT_FALSE(evaluate().parameters);
  EXPECT_FALSE(next_.is_known());
  answer(200, {1, 2, 5});
  const NextExperiment::Outcome outcome = evaluate();
  ASSERT_TRUE(outcome.parameters);
  EXPECT_EQ(outcome.parameters->active_ids(), (std::vector<std::int32_t>{1, 2, 5}));
  EXPECT_TRUE(next_.is_known());
  next_.begin();
  EXPECT_FALSE(next_.is_known());
}

TEST_F(NextExperimentTest, MayChangeUntilItBegins) {
  ASSERT_TRUE(next_.request_is_due(1));
  answer(200, {1, 2, 5});
  ASSERT_TRUE(evaluate().parameters);
  ASSERT_TRUE(next_.request_is_due(2 * kNanosecondsPerSecond));
  EXPECT_FALSE(evaluate().parameters) << "not answered yet";
  EXPECT_TRUE(next_.is_known()) << "unchanged since it became known";
  answer(200, {1, 5});
  EXPECT_NE(evaluate().problem, "");
  EXPECT_FALSE(next_.is_known());
}

TEST_F(NextExperimentTest, AProblemIsSaidOnceUntilItChanges) {
  ASSERT_TRUE(next_.request_is_due(1));
  answer(100, {1, 2});
  EXPECT_EQ(evaluate().problem,
            "middleware_period_ms = 100 ms, must be the 200 ms of this process's start");
  EXPECT_EQ(evaluate().problem, "");
  ASSERT_TRUE(next_.request_is_due(2 * kNanosecondsPerSecond));
  answer(200, {1});
  EXPECT_THAT(evaluate().problem, HasSubstr(kActiveIdsParameter));
  ASSERT_TRUE(next_.request_is_due(4 * kNanosecondsPerSecond));
  answer(100, {1, 2});
  EXPECT_NE(evaluate().problem, "");
}

}  // namespace
}  // namespace hlc::middleware
