#include "planner/road/speed_sections.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "planner/road/goal.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::road {
namespace {

/// A square of 4 m, closed or open.
ReferencePath square(bool closed) {
  return {{Point(0.0, 0.0), Point(1.0, 0.0), Point(1.0, 1.0), Point(0.0, 1.0)}, closed};
}

constexpr double kFast_mps = 0.8;

double speed_at(const std::vector<SpeedSection>& sections, const ReferencePath& path, double from,
                double to) {
  return least_speed_mps(sections, path, from, to, kFast_mps);
}

TEST(SpeedSections, SlowWhatTouchesThem) {
  const std::vector<SpeedSection> sections{{1.0, 2.0, 0.4}, {2.0, 2.5, 0.6}};
  for (const bool is_closed : {true, false}) {
    const ReferencePath path = square(is_closed);
    EXPECT_EQ(speed_at(sections, path, 0.0, 1.0), kFast_mps) << "it ends where the first begins";
    EXPECT_EQ(speed_at(sections, path, 0.0, 1.01), 0.4);
    EXPECT_EQ(speed_at(sections, path, 1.5, 1.6), 0.4);
    EXPECT_EQ(speed_at(sections, path, 1.9, 2.1), 0.4) << "the slower of two";
    EXPECT_EQ(speed_at(sections, path, 2.0, 2.1), 0.6);
    EXPECT_EQ(speed_at(sections, path, 2.5, 2.9), kFast_mps);
  }
}

TEST(SpeedSections, MakeNothingFaster) {
  EXPECT_EQ(speed_at({{0.0, 3.0, 1.2}}, square(true), 1.0, 1.5), kFast_mps);
}

TEST(SpeedSections, OfAClosedPathComeAgainInEachLap) {
  const ReferencePath path = square(true);
  const std::vector<SpeedSection> around_begin{{3.5, 4.5, 0.4}};
  for (const double lap_m : {-8.0, -4.0, 0.0, 4.0, 12.0}) {
    EXPECT_EQ(speed_at(around_begin, path, lap_m + 0.4, lap_m + 0.6), 0.4) << lap_m;
    EXPECT_EQ(speed_at(around_begin, path, lap_m + 3.4, lap_m + 3.6), 0.4) << lap_m;
    EXPECT_EQ(speed_at(around_begin, path, lap_m + 0.6, lap_m + 3.4), kFast_mps) << lap_m;
  }
}

TEST(SpeedSections, OfAPathUntilAPlaceAreThoseOnTheWayThere) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto drawn = [&random](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
    const ReferencePath path = square(seed % 2 == 0);
    const double from_s_m = drawn(0.0, 2.5);
    const double length_m = drawn(0.1, path.is_closed() ? 2.9 : 0.4);
    const std::vector<SpeedSection> sections{{from_s_m, from_s_m + length_m, drawn(0.1, 0.9)}};
    const double end_s_m = drawn(0.5, path.is_closed() ? 7.9 : 3.0);
    const std::vector<SpeedSection> until = sections_until(sections, path, end_s_m);
    const ReferencePath open = path_until(path, end_s_m);
    for (double s_m = 0.0; s_m + 0.01 < end_s_m; s_m += 0.01) {
      ASSERT_EQ(speed_at(until, open, s_m, s_m + 0.01), speed_at(sections, path, s_m, s_m + 0.01))
          << s_m;
    }
  }
}

}  // namespace
}  // namespace hlc::road
