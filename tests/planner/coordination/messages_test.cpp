#include "planner/coordination/messages.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "planner/geometry/footprint.hpp"

namespace hlc::coordination {
namespace {

ConvexPolygon square_here(double x) { return footprint_area({1.0, 1.0}, {x, 0.0, 0.0}); }

TEST(OccupiedAreas, EveryStepHasItsAreaAndTheFinalOneHoldsForEver) {
  const OccupiedAreas areas{.first = {5},
                            .areas_m = {square_here(0.0), square_here(1.0)},
                            .final_area_m = square_here(2.0)};
  EXPECT_EQ(areas.during({5}), square_here(0.0));
  EXPECT_EQ(areas.during({6}), square_here(1.0));
  EXPECT_EQ(areas.during({7}), square_here(2.0));
  EXPECT_EQ(areas.during({700}), square_here(2.0));
}

TEST(Messages, AnEmptyAreaOrAWrongBeginIsNotWellFormed) {
  Traffic traffic;
  traffic.step = {5};
  traffic.running = {.first = {5}, .areas_m = {square_here(0.0)}, .final_area_m = square_here(1.0)};
  traffic.reachable_area_m = square_here(0.0);
  EXPECT_TRUE(is_well_formed(traffic));
  Traffic nowhere = traffic;
  nowhere.reachable_area_m = {};
  EXPECT_FALSE(is_well_formed(nowhere));
  Traffic hole = traffic;
  hole.running.areas_m[0] = {};
  EXPECT_FALSE(is_well_formed(hole));
  Prediction late{.vehicle = {1}, .step = {5}, .areas = traffic.running};
  EXPECT_FALSE(is_well_formed(late)) << "a prediction begins at the next step";
  late.areas.first = {6};
  EXPECT_TRUE(is_well_formed(late));
  late.desired = traffic.running;
  EXPECT_FALSE(is_well_formed(late)) << "a desired plan, too";
  late.desired->first = {6};
  EXPECT_TRUE(is_well_formed(late));
}

TEST(Messages, AClaimThatIsNoPlaceIsNotWellFormed) {
  Traffic traffic;
  traffic.running.final_area_m = square_here(0.0);
  traffic.reachable_area_m = square_here(0.0);
  const auto is_good = [&](double place_m, double ahead_m) {
    traffic.claim = LaneClaim{.place_m = place_m, .ahead_m = ahead_m};
    return is_well_formed(traffic);
  };
  EXPECT_TRUE(is_well_formed(traffic)) << "no claim: no right of way";
  EXPECT_TRUE(is_good(0.0, 0.0));
  EXPECT_TRUE(is_good(12.5, 1.6));
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -1e-9, -kInfinite, kInfinite,
                           2.0 * kLargestCoordinate_m}) {
    EXPECT_FALSE(is_good(bad, 1.6)) << bad;
    EXPECT_FALSE(is_good(12.5, bad)) << bad;
  }
}

}  // namespace
}  // namespace hlc::coordination
