#include "hlc_bridge/result/statistics.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hlc::result::statistics_test {
namespace {

TEST(Statistics, KnownSample) {
  const std::vector<double> sample{2, 4, 4, 4, 5, 5, 7, 9};
  const Statistics result = statistics(sample).value();
  EXPECT_EQ(result.count, 8U);
  EXPECT_DOUBLE_EQ(result.mean, 5.0);
  EXPECT_NEAR(result.std, 2.13808993529939, 1e-13);  // sqrt(32 / 7)
  EXPECT_EQ(result.min, 2.0);
  EXPECT_EQ(result.max, 9.0);
  EXPECT_EQ(result.p99, 9.0);
}

TEST(Statistics, NinetyNinthPercentileIsTheNearestRank) {
  std::vector<double> sample;
  for (int i = 200; i >= 1; --i) {
    sample.push_back(i);
  }
  EXPECT_EQ(statistics(sample)->p99, 198.0);
  sample.resize(150);  // 51 ... 200; ceil(0.99 * 150) = 149
  EXPECT_EQ(statistics(sample)->p99, 199.0);
}

TEST(Statistics, OneValueHasNoSpread) {
  const Statistics result = statistics(std::vector<double>{3.0}).value();
  EXPECT_EQ(result.mean, 3.0);
  EXPECT_EQ(result.std, 0.0);
  EXPECT_EQ(result.p99, 3.0);
}

TEST(Statistics, EmptySampleHasNone) { EXPECT_FALSE(statistics({}).has_value()); }

}  // namespace
}  // namespace hlc::result::statistics_test
