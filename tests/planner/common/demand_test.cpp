#include "planner/common/demand.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace hlc {
namespace {

enum class Mode : std::uint8_t { kFirst, kSecond };
struct Id {
  std::uint8_t value{0};
};

TEST(Demand, OfATrueConditionDoesNothingAndEvaluatesNoValue) {
  int evaluated = 0;
  HLC_DEMAND(evaluated == 0, ++evaluated);
  EXPECT_EQ(evaluated, 0);
}

TEST(DemandDeathTest, OfAFalseConditionPrintsPlaceConditionAndValuesAndAborts) {
  const std::vector<int> list{1, 2};
  const std::size_t needed = 3;
  EXPECT_EXIT(HLC_DEMAND(list.size() >= needed, list.size(), needed),
              testing::KilledBySignal(SIGABRT),
              "^tests/planner/common/demand_test.cpp:[0-9]+: demanded list.size\\(\\) >= needed; "
              "list.size\\(\\), needed = 2, 3\n$");
}

TEST(DemandDeathTest, NeedsNoValues) {
  const bool holds = false;
  EXPECT_DEATH(HLC_DEMAND(holds && "why"), "demanded holds && \"why\"\n$");
}

TEST(DemandDeathTest, ShowsValuesOfEveryKind) {
  const bool holds = false;
  const std::string text = "some text";
  EXPECT_DEATH(HLC_DEMAND(holds, -0.25, -7, 7U, true, 'a', Mode::kSecond, Id{5}, text, "literal"),
               "= -0.25, -7, 7, true, 97, 1, 5, some text, literal\n$");
}

TEST(DemandDeathTest, IsOneStatement) {
  const int number = 2;
  if (number > 1)
    HLC_DEMAND(number == 2, number);
  else
    FAIL() << "the else belongs to the if";
  EXPECT_DEATH(HLC_DEMAND(number < 0, number), "number = 2\n$");
}

}  // namespace
}  // namespace hlc
