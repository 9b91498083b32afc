#include "planner/geometry/median.hpp"

#include <gtest/gtest.h>

namespace hlc {
namespace {

TEST(Median, IsTheValueInTheMiddleWhateverTheOrder) {
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0}), 4.0);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({1.0, 2.0}), 1.5);
  EXPECT_EQ(median({10.0, 3.0, 0.0, 5.0}), 4.0);
}

}  // namespace
}  // namespace hlc
