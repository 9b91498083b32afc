#include "planner/road/corridor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/num_seeds.hpp"

namespace hlc::road {
namespace {

Corridor::Piece piece(double from_s_m, double to_s_m) {
  return {.segment = {.from_m = Point(from_s_m, 0.0), .to_m = Point(to_s_m, 0.0)},
          .from_s_m = from_s_m,
          .to_s_m = to_s_m};
}

TEST(Corridor, WithoutPiecesHasNoBoundary) {
  EXPECT_TRUE(Corridor().boundary_m(-100.0, 100.0).empty());
}

TEST(Corridor, OpenRouteDoesNotRepeat) {
  const Corridor corridor({piece(0.0, 1.0), piece(1.0, 2.0)}, 0.0);
  EXPECT_EQ(corridor.boundary_m(0.2, 0.8).size(), 1U);
  EXPECT_EQ(corridor.boundary_m(0.2, 1.8).size(), 2U);
  EXPECT_TRUE(corridor.boundary_m(2.1, 4.0).empty());
}

TEST(Corridor, ClosedRouteRepeatsAndGivesEachPieceOnce) {
  const Corridor corridor({piece(-0.1, 1.0), piece(3.0, 4.1)}, 4.0);
  EXPECT_EQ(corridor.boundary_m(3.95, 4.0).size(), 2U);
  EXPECT_EQ(corridor.boundary_m(-0.3, -0.2).size(), 1U);
  EXPECT_EQ(corridor.boundary_m(4.2, 4.3).size(), 1U);
  EXPECT_EQ(corridor.boundary_m(-20.0, 20.0).size(), 2U);
  EXPECT_TRUE(corridor.boundary_m(5.5, 6.5).empty());
}

TEST(Corridor, PieceIsGivenIfAndOnlyIfOneOfItsRepetitionsMeetsTheWindow) {
  for (std::uint64_t seed = 1; seed <= test::num_seeds(500); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const double length_m = std::uniform_real_distribution(1.0, 10.0)(random);
    const double window_from = std::uniform_real_distribution(-15.0, 15.0)(random);
    const double window_to = window_from + std::uniform_real_distribution(0.0, length_m)(random);
    std::vector<Corridor::Piece> pieces;
    std::vector<double> expected;
    double from = std::uniform_real_distribution(-0.2, length_m)(random);
    for (int i = 0; i < 40; ++i) {  // one after the other but for a jump now and then
      if (i % 7 == 6) from = std::uniform_real_distribution(-0.2, length_m)(random);
      const double to = from + std::uniform_real_distribution(0.0, 0.3)(random);
      pieces.push_back(piece(from, to));
      bool meets = false;
      for (int k = -40; k <= 40; ++k) {
        meets = meets || (from + k * length_m <= window_to && to + k * length_m >= window_from);
      }
      if (meets) expected.push_back(from);
      from = to < length_m ? to : to - length_m;
    }
    std::vector<double> given;
    for (const Segment& segment : Corridor(pieces, length_m).boundary_m(window_from, window_to)) {
      given.push_back(segment.from_m.x());
    }
    EXPECT_EQ(given, expected);
  }
}

}  // namespace
}  // namespace hlc::road
