#include "vehicle_sim/campaign/tradeoff_front.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::campaign::tradeoff_front_test {
namespace {

TradeoffPoint point(double x, double y, bool is_policy = false) {
  maneuver_design::Objectives values(2);
  values << x, y;
  return {.is_policy = is_policy, .values = values};
}

TEST(TradeoffFront, APolicyCountsByWhatItAddsToAllFixedOnes) {
  const std::vector<TradeoffPoint> points{point(1.0, 3.0), point(3.0, 1.0), point(2.0, 2.0, true),
                                          point(3.0, 3.0, true), point(0.5, 4.0, true)};
  const maneuver_design::Objectives reference = maneuver_design::Objectives::Constant(2, 4.0);
  const TradeoffFront front = front_of(points, reference);
  EXPECT_EQ(front.not_dominated, (std::vector<std::size_t>{0, 1, 2, 4}));
  EXPECT_DOUBLE_EQ(front.fixed_volume, 3.0 + 3.0 - 1.0);
  EXPECT_EQ(front.volume_with, (std::vector<double>{5.0, 5.0, 6.0, 5.0, 5.0}));
}

TEST(TradeoffFront, TheReferencePointIsBeyondTheWorstOfEachQuantity) {
  const maneuver_design::Objectives reference =
      reference_of({point(1.0, 30.0), point(2.0, 10.0, true)});
  EXPECT_DOUBLE_EQ(reference(0), 1.05 * 2.0);
  EXPECT_DOUBLE_EQ(reference(1), 1.05 * 30.0);
}

// Whole numbers, so that every cell of the grid is dominated wholly or not at all.
TEST(TradeoffFront, VolumesAreNumbersOfCellsThatAreDominated) {
  constexpr int kCells = 20;
  for (std::uint32_t seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(0, kCells);
    std::uniform_int_distribution<std::size_t> size(1, 8);
    std::vector<TradeoffPoint> points(size(random));
    for (TradeoffPoint& one : points) {
      one = point(place(random), place(random), random() % 3 == 0);
    }
    const TradeoffFront front = front_of(points, maneuver_design::Objectives::Constant(2, kCells));
    /// @param with  a point beside the fixed ones
    const auto cells = [&](std::optional<std::size_t> with) {
      int count = 0;
      for (int x = 0; x < kCells; ++x) {
        for (int y = 0; y < kCells; ++y) {
          bool is_dominated = false;
          for (std::size_t i = 0; i < points.size(); ++i) {
            const bool counts = !points[i].is_policy || i == with;
            is_dominated =
                is_dominated || (counts && points[i].values(0) <= x && points[i].values(1) <= y);
          }
          count += is_dominated ? 1 : 0;
        }
      }
      return count;
    };
    EXPECT_DOUBLE_EQ(front.fixed_volume, cells({}));
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_DOUBLE_EQ(front.volume_with[i], cells(i)) << "point " << i;
      const bool is_in_front = std::ranges::none_of(points, [&](const TradeoffPoint& other) {
        return (other.values.array() <= points[i].values.array()).all() &&
               other.values != points[i].values;
      });
      EXPECT_EQ(std::ranges::count(front.not_dominated, i), is_in_front ? 1 : 0) << "point " << i;
    }
  }
}

}  // namespace
}  // namespace hlc::campaign::tradeoff_front_test
