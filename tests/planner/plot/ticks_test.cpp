#include "planner/plot/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hlc::plot {
namespace {

using testing::Message;

TEST(Ticks, AreRoundAndCoverTheRange) {
  constexpr unsigned kSeed = 5;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  std::uniform_real_distribution<double> middle(-3.0, 3.0);
  for (int run = 0; run < 500; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    const double width = std::pow(10.0, exponent(random));
    const double min = middle(random) * width;
    const std::vector<double> ticks = nice_ticks(min, min + width);
    ASSERT_GE(ticks.size(), 2U);
    ASSERT_LE(ticks.size(), 8U);
    const double step = ticks[1] - ticks[0];
    const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(leading - 1.0) < 1e-6 || std::abs(leading - 2.0) < 1e-6 ||
                std::abs(leading - 5.0) < 1e-6)
        << step;
    EXPECT_LT(ticks.front() - min, step * (1.0 + 1e-6));
    EXPECT_LT(min + width - ticks.back(), step * (1.0 + 1e-6));
    for (const double tick : ticks) {
      EXPECT_NEAR(tick / step, std::round(tick / step), 1e-6);
    }
  }
  EXPECT_EQ(nice_ticks(0.0, 1.0),
            (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
}

TEST(LogTicks, ArePowersOfTenAndBetweenThemWhereThatAreFew) {
  const std::vector<double> many = log_ticks(0.02, 3000.0);
  ASSERT_EQ(many.size(), 5U);
  for (std::size_t i = 0; i < many.size(); ++i) {
    EXPECT_NEAR(many[i], std::pow(10.0, static_cast<double>(i) - 1.0), 1e-9 * many[i]);
  }
  const std::vector<double> few = log_ticks(2.0, 60.0);
  ASSERT_EQ(few.size(), 5U);
  EXPECT_NEAR(few.front(), 2.0, 1e-9);
  EXPECT_NEAR(few.back(), 50.0, 1e-9);
}

}  // namespace
}  // namespace hlc::plot
