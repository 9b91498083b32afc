#include "planner/road/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/road/lab_like_map.hpp"
#include "planner/road/route.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::road {
namespace {

constexpr Footprint kFootprint{.length_m = 0.220, .width_m = 0.107};
/// The outline is compared with the bounds point by point.
constexpr double kRounding_m = 0.005;

/// A lane along x from 0 to 10 m, 0.2 m wide, in the middle of a strip of ground of 0.5 m.
DrivableRoute straight_lane() {
  const std::vector<double> s_m{0.0, 2.0, 4.0, 6.0, 8.0, 10.0};
  std::vector<Corridor::Bound> bounds;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Corridor::Bound bound{.side = side, .points_m = {}, .s_m = s_m};
    for (const double s : s_m) bound.points_m.emplace_back(s, side == Side::kLeft ? 0.1 : -0.1);
    bounds.push_back(std::move(bound));
  }
  const Box ground{.min_m = {0.0, -0.25}, .max_m = {10.0, 0.25}};
  return {.name = "straight",
          .path = ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false),
          .corridor = Corridor(std::move(bounds), 0.0, ground)};
}

/// Circuits of the map that the project ships.
std::vector<DrivableRoute> circuits() {
  const RoadNetwork network = lab_like_map();
  std::vector<DrivableRoute> routes;
  for (const NamedRoute& named : network.routes) {
    Route route = build_route(network.map, named.lanelets, true);
    routes.push_back({named.name, std::move(route.path), std::move(route.corridor)});
  }
  return routes;
}

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution(from, to)(random);
}

bool crosses(const Pose& pose, const Corridor& corridor, double s_m) {
  const ConvexPolygon area = footprint_area(kFootprint, pose);
  for (const Segment& piece : corridor.boundary_m(s_m - 0.4, s_m + 0.4)) {
    if (intersects(area, piece)) return true;
  }
  return false;
}

TEST(Placement, OnAStraightLaneIsWhatItIsMadeOf) {
  const Placement placement = placement_on(straight_lane(), {3.0, 0.08, 0.0}, kFootprint);
  EXPECT_NEAR(placement.s_m, 3.0, 1e-12);
  EXPECT_NEAR(placement.distance_m, 0.08, 1e-12);
  EXPECT_NEAR(placement.turned_rad, 0.0, 1e-12);
  EXPECT_NEAR(placement.beyond_left_m, 0.08 + 0.0535 - 0.1, 1e-12);
  EXPECT_NEAR(placement.beyond_right_m, -0.08 + 0.0535 - 0.1, 1e-12);
  EXPECT_TRUE(placement.is_on_ground);
}

TEST(Placement, FitsUpToTheStatedBounds) {
  const DrivableRoute route = straight_lane();
  const auto fits_at = [&route](const Pose& pose) {
    return fits(placement_on(route, pose, kFootprint), route);
  };
  EXPECT_TRUE(fits_at({3.0, 0.0, kFitsTurned_rad - 0.001}));
  EXPECT_FALSE(fits_at({3.0, 0.0, kFitsTurned_rad + 0.001}));
  EXPECT_TRUE(fits_at({3.0, 0.19, 0.0}));
  EXPECT_FALSE(fits_at({3.0, 0.197, 0.0})) << "not on the map";
  EXPECT_FALSE(fits_at({3.0, 0.0, 3.1})) << "against the lane";
  DrivableRoute wide = route;
  wide.corridor =
      Corridor(route.corridor.bounds(), 0.0, {.min_m = {0.0, -9.0}, .max_m = {10.0, 9.0}});
  const double most_m = 0.1 + kFitsBeyond_m - 0.0535;
  EXPECT_TRUE(fits(placement_on(wide, {3.0, most_m - 0.001, 0.0}, kFootprint), wide));
  EXPECT_FALSE(fits(placement_on(wide, {3.0, most_m + 0.001, 0.0}, kFootprint), wide));
}

TEST(Placement, FitsAnywhereWhereThereAreNoLanes) {
  DrivableRoute open = straight_lane();
  open.corridor = Corridor();
  EXPECT_TRUE(fits(placement_on(open, {5.0, 4.0, 2.0}, kFootprint), open));
}

TEST(Placement, OnAnOpenPathThatEndsWhereItBeganIsNotAtTheBeginAgain) {
  const DrivableRoute loop{
      .name = "loop",
      .path = ReferencePath({Point(2.0, 0.0), Point(4.0, 0.0), Point(4.0, 4.0), Point(0.0, 4.0),
                             Point(0.0, 0.0), Point(2.0, 0.0)},
                            false),
      .corridor = {}};
  const Pose beyond_the_end{2.07, 0.01, 0.0};
  EXPECT_NEAR(placement_on(loop, beyond_the_end, kFootprint, 15.5).s_m, 16.0, 1e-9);
  EXPECT_NEAR(placement_on(loop, beyond_the_end, kFootprint, 0.0).s_m, 0.07, 1e-9);
  const Pose moved_back{3.0, 0.0, 0.0};
  EXPECT_NEAR(placement_on(loop, moved_back, kFootprint, 15.5).s_m, 1.0, 1e-9)
      << "somebody has put it there";
}

// Twenty cars with random turns knotted behind one that, as it waited where two lanes part, took
// its place on the other lane for its own, 122 m further on its tour.
TEST(Placement, AVehicleThatStandsAskewWhereLanesPartStaysOnTheLaneThatItIsDriving) {
  const std::vector<Point> corners{{0.0, 0.0},   {2.0, 0.0},  {4.0, 0.0},  {4.0, -4.0},
                                   {-2.0, -4.0}, {-2.0, 0.0}, {0.0, 0.0},  {2.0, 0.0},
                                   {4.0, 0.4},   {4.0, 4.0},  {-4.0, 4.0}, {-4.0, 0.0}};
  for (const bool closed : {false, true}) {
    const DrivableRoute tour{
        .name = "tour", .path = ReferencePath(corners, closed), .corridor = {}};
    const double again_m = 4.0 + 4.0 + 6.0 + 4.0 + 2.0;  // arc length of (0, 0) the second time
    const Pose askew{3.0, 0.12, 0.15};
    EXPECT_NEAR(placement_on(tour, askew, kFootprint, 2.7).s_m, 3.0, 1e-9) << closed;
    EXPECT_NEAR(placement_on(tour, askew, kFootprint, again_m + 2.7).s_m, again_m + 3.0, 0.05);
    EXPECT_NEAR(placement_on(tour, askew, kFootprint).s_m, again_m + 3.0, 0.05)
        << "the best one, where nothing is known";
    const Pose moved{4.0, 3.0, 1.6};
    EXPECT_GT(placement_on(tour, moved, kFootprint, 2.7).s_m, again_m + 4.0) << closed;
  }
}

TEST(Placement, IsOnTheNextPieceOfALongPieceToo) {
  for (const bool closed : {false, true}) {
    const DrivableRoute ring{
        .name = "ring",
        .path = ReferencePath(
            {Point(0.0, 0.0), Point(2.0, 0.0), Point(4.0, 0.0), Point(4.0, 4.0), Point(0.0, 4.0)},
            closed),
        .corridor = {}};
    EXPECT_NEAR(placement_on(ring, {2.1, 0.0, 0.0}, kFootprint, 1.8).s_m, 2.1, 1e-9);
  }
}

TEST(Placement, AVehicleMovedBackOverTheBeginOfAClosedPathIsAtItsEnd) {
  const DrivableRoute ring{
      .name = "ring",
      .path =
          ReferencePath({Point(0.0, 0.0), Point(4.0, 0.0), Point(4.0, 4.0), Point(0.0, 4.0)}, true),
      .corridor = {}};
  EXPECT_NEAR(placement_on(ring, {0.0, 0.1, -1.0}, kFootprint, 0.1 - 0.3).s_m, 15.9, 1e-9);
}

TEST(Placement, OfTwoStrandsThatCrossIsOnTheOneThatTheVehiclePointsAlong) {
  const DrivableRoute route{
      .name = "loop",
      .path = ReferencePath(
          {Point(0.0, 0.0), Point(4.0, 0.0), Point(4.0, 2.0), Point(2.0, 2.0), Point(2.0, -2.0)},
          false),
      .corridor = {}};
  EXPECT_NEAR(placement_on(route, {2.01, 0.0, 0.2}, kFootprint).s_m, 2.01, 1e-9);
  EXPECT_NEAR(placement_on(route, {2.01, 0.0, -1.4}, kFootprint).s_m, 10.0, 1e-9);
}

TEST(Placement, FindsAVehicleThatWasPutBesideACircuitAndHowFarItReachesBeyond) {
  const std::vector<DrivableRoute> routes = circuits();
  for (std::uint64_t seed = 1; seed <= test::num_seeds(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const DrivableRoute& route = routes[seed % routes.size()];
    const double s_m = uniform(random, 0.0, route.path.length_m());
    const Point on_path = route.path.at(s_m);
    const double turned_rad = uniform(random, -0.35, 0.35);
    const Pose pose = compose({on_path.x(), on_path.y(), route.path.heading_rad_at(s_m)},
                              {0.0, uniform(random, -0.1, 0.1), turned_rad});
    const Placement placement = placement_on(route, pose, kFootprint);
    const double off_m = std::abs(std::remainder(placement.s_m - s_m, route.path.length_m()));
    ASSERT_LT(off_m, 0.1);
    ASSERT_NEAR(placement.turned_rad, turned_rad, 0.4);
    const Widening widening{.from_s_m = placement.s_m - 1.0,
                            .to_s_m = placement.s_m + 1.0,
                            .left_m = std::max(0.0, placement.beyond_left_m + kRounding_m),
                            .right_m = std::max(0.0, placement.beyond_right_m + kRounding_m)};
    DrivableRoute wide = route;
    wide.corridor = widened(route, widening);
    if (placement.beyond_m() < -kRounding_m) {
      ASSERT_FALSE(crosses(pose, route.corridor, placement.s_m));
    } else if (placement.beyond_m() > kRounding_m) {
      ASSERT_TRUE(crosses(pose, route.corridor, placement.s_m));
    }
    if (placement.is_on_ground) {
      ASSERT_FALSE(crosses(pose, wide.corridor, placement.s_m));
    }
    ASSERT_LE(placement_on(wide, pose, kFootprint).beyond_m(), placement.is_on_ground ? 0.0 : 0.2);
  }
}

TEST(Widening, LeavesTheRestOfTheRouteAloneAndStaysOnTheMap) {
  const DrivableRoute route = straight_lane();
  const Corridor wide =
      widened(route, {.from_s_m = 3.0, .to_s_m = 7.0, .left_m = 0.05, .right_m = 0.4});
  for (std::size_t side = 0; side < 2; ++side) {
    const Corridor::Bound& bound = wide.bounds()[side];
    const double out_m = side == 0 ? 0.15 : -0.25;
    const double plain_m = side == 0 ? 0.1 : -0.1;
    for (const Point& point : bound.points_m) {
      const bool is_inside = point.x() > 3.0 && point.x() < 7.0;
      EXPECT_NEAR(point.y(), is_inside ? out_m : plain_m, 1e-12) << point.x();
    }
  }
}

}  // namespace
}  // namespace hlc::road
