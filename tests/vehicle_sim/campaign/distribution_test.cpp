#include "vehicle_sim/campaign/distribution.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hlc::campaign::distribution_test {
namespace {

TEST(Distribution, ExceedanceIsTheShareThatIsAtLeastAsLarge) {
  const PlotPoints points = exceedance({0.1, 0.2, 0.2, 0.4, 3.0});
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[0], Eigen::Vector2d(0.1, 100.0));
  EXPECT_EQ(points[1], Eigen::Vector2d(0.2, 80.0));
  EXPECT_EQ(points[3], Eigen::Vector2d(0.4, 40.0));
  EXPECT_EQ(points[4], Eigen::Vector2d(3.0, 20.0));
  EXPECT_TRUE(exceedance({}).empty());
}

// 1.2 and 1.25 lie in [10^0, 10^0.1), 1.3 in the next bin, 2.0 in [10^0.3, 10^0.4).
TEST(Distribution, HistogramHasTenBinsADecadeAndPercentages) {
  const PlotPoints points = decade_histogram({1.2, 1.25, 1.3, 2.0});
  std::vector<double> edges;
  std::vector<double> heights;
  for (const Eigen::Vector2d& point : points) {
    edges.push_back(10.0 * std::log10(point.x()));
    heights.push_back(point.y());
  }
  const auto near = [](double value) { return testing::DoubleNear(value, 1e-9); };
  EXPECT_THAT(edges, testing::ElementsAre(near(0), near(0), near(1), near(1), near(2), near(2),
                                          near(3), near(3), near(4), near(4)));
  EXPECT_THAT(heights, testing::ElementsAre(0, 50, 50, 25, 25, 0, 0, 25, 25, 0));
  EXPECT_TRUE(decade_histogram({}).empty());
}

}  // namespace
}  // namespace hlc::campaign::distribution_test
