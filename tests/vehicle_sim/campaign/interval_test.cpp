#include "vehicle_sim/campaign/interval.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hlc::campaign::interval_test {
namespace {

TEST(Interval, IsStudents) {
  // Mean 3, s = sqrt(2.5), t = 2.7764 for 4 degrees of freedom: 2.7764 sqrt(2.5 / 5).
  const Interval interval = interval_of_mean({1.0, 2.0, 3.0, 4.0, 5.0}).value();
  EXPECT_DOUBLE_EQ(interval.mean, 3.0);
  EXPECT_NEAR(interval.half_width.value(), 1.9632, 1e-4);
  EXPECT_EQ(interval.count, 5U);
  EXPECT_TRUE(interval.is_off_zero());
  EXPECT_EQ(in_words(interval, 1), "3.0 ± 2.0");
}

TEST(Interval, OneValueHasNoneAndIsSureOfNothing) {
  const Interval interval = interval_of_mean({7.0}).value();
  EXPECT_FALSE(interval.half_width);
  EXPECT_FALSE(interval.is_off_zero());
  EXPECT_EQ(in_words(interval, 2), "7.00");
  EXPECT_FALSE(interval_of_mean({}));
  EXPECT_EQ(in_words(std::nullopt, 2), "-");
}

TEST(Interval, ValuesOfOneStartCountAsOne) {
  const auto once = interval_over_starts({{0, {1.0}}, {1, {3.0}}});
  const auto often = interval_over_starts({{0, {1.0, 1.0, 1.0}}, {1, {2.0, 4.0}}, {2, {}}});
  EXPECT_EQ(often->count, 2U);
  EXPECT_EQ(often->mean, once->mean);
  EXPECT_EQ(often->half_width, once->half_width);
}

TEST(Interval, HoldsTheTrueMeanIn95OfAHundredSamples) {
  for (const std::size_t size : {2U, 4U, 11U, 64U}) {
    const unsigned seed = 17 + static_cast<unsigned>(size);
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::normal_distribution<double> value(5.0, 2.0);
    constexpr int kSamples = 20000;
    int holds = 0;
    for (int i = 0; i < kSamples; ++i) {
      std::vector<double> sample(size);
      for (double& one : sample) one = value(random);
      const Interval interval = interval_of_mean(sample).value();
      holds += std::abs(interval.mean - 5.0) <= interval.half_width.value() ? 1 : 0;
    }
    // 0.95 with a standard deviation of 0.0015.
    EXPECT_NEAR(static_cast<double>(holds) / kSamples, 0.95, 0.006) << size;
  }
}

}  // namespace
}  // namespace hlc::campaign::interval_test
