#include "hlc_bridge/messages/run_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hlc::run_parameters_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const ParameterValue kIds = std::vector<std::int32_t>{1, 2};

TEST(RunParameters, AreCompleteWhenBothAreAnswered) {
  RunParameters parameters;
  EXPECT_THAT(parameters.missing(), ElementsAre("middleware_period_ms", "active_vehicle_ids"));
  parameters.take({"active_vehicle_ids", kIds});
  EXPECT_FALSE(parameters.complete());
  EXPECT_THAT(parameters.missing(), ElementsAre("middleware_period_ms"));
  parameters.take({"middleware_period_ms", std::uint64_t{200}});
  EXPECT_TRUE(parameters.complete());
  EXPECT_THAT(parameters.missing(), IsEmpty());
  EXPECT_EQ(parameters.period(), 200'000'000U);
  EXPECT_THAT(parameters.active_ids(), ElementsAre(1, 2));
}

TEST(RunParameters, OfSeveralAnswersTheFirstCounts) {
  RunParameters parameters;
  parameters.take({"middleware_period_ms", std::uint64_t{200}});
  parameters.take({"middleware_period_ms", std::uint64_t{300}});
  parameters.take({"active_vehicle_ids", kIds});
  parameters.take({"active_vehicle_ids", std::vector<std::int32_t>{3}});
  EXPECT_EQ(parameters.period(), 200'000'000U);
  EXPECT_THAT(parameters.active_ids(), ElementsAre(1, 2));
}

TEST(RunParameters, ValuesOfAnotherTypeAndOtherNamesAreIgnored) {
  RunParameters parameters;
  parameters.take({"middleware_period_ms", std::int32_t{200}});
  parameters.take({"middleware_period_ms", std::monostate{}});
  parameters.take({"active_vehicle_ids", std::uint64_t{1}});
  parameters.take({"period", std::uint64_t{200}});
  parameters.take({"ids", kIds});
  EXPECT_FALSE(parameters.complete());
  EXPECT_EQ(parameters.missing().size(), 2U);
}

}  // namespace
}  // namespace hlc::run_parameters_test
