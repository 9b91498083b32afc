#include "planner/right_of_way/conflict_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <random>
#include <utility>

#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::right_of_way {
namespace {

std::size_t num_conflicts(const ConflictMap& map, std::size_t route) {
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
    count += map.is_conflict(route, cell) ? 1U : 0U;
  }
  return count;
}

/// Cells of the other route that overlap this one, ascending.
std::vector<std::size_t> overlaps(const ConflictMap& map, std::size_t route, std::size_t cell,
                                  std::size_t other) {
  const auto numbers = map.overlaps(route, cell);
  std::vector<std::size_t> cells;
  for (std::size_t j = 0; j < map.num_cells(other); ++j) {
    if (std::ranges::binary_search(numbers, map.cell(other, j))) cells.push_back(j);
  }
  return cells;
}

bool overlap_at_all(const ConflictMap& map, std::size_t route, std::size_t other) {
  for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
    if (!overlaps(map, route, cell, other).empty()) return true;
  }
  return false;
}

double cell_s_m(const ConflictMap& map, std::size_t route, std::size_t cell) {
  return map.cell_m(route) * static_cast<double>(cell);
}

/// Along the closed route.
double apart_m(const ConflictMap& map, std::size_t route, double a_m, double b_m) {
  return std::abs(std::remainder(a_m - b_m, map.length_m(route)));
}

/// Of the cell to the nearest of these places on its route.
double nearest_m(const ConflictMap& map, std::size_t route, std::size_t cell,
                 const std::vector<double>& places_m) {
  double nearest_m = map.length_m(route);
  for (const double place_m : places_m) {
    nearest_m = std::min(nearest_m, apart_m(map, route, cell_s_m(map, route, cell), place_m));
  }
  return nearest_m;
}

void expect_symmetric(const ConflictMap& map) {
  for (std::size_t a = 0; a < map.num_routes(); ++a) {
    for (std::size_t b = 0; b < map.num_routes(); ++b) {
      for (std::size_t i = 0; i < map.num_cells(a); ++i) {
        EXPECT_TRUE(std::ranges::is_sorted(map.overlaps(a, i)));
        for (const std::size_t j : overlaps(map, a, i, b)) {
          EXPECT_TRUE(std::ranges::binary_search(map.overlaps(b, j), map.cell(a, i)))
              << a << ' ' << i << ' ' << b << ' ' << j;
        }
      }
    }
  }
}

std::vector<road::DrivableRoute> crossing_circles() {
  return {circle({0.0, 0.0}, 1.0), circle({1.2, 0.0}, 1.0)};
}

TEST(ConflictMap, CellsAreOfEqualLengthAndAboutThatOfTheRules) {
  const ConflictMap map(crossing_circles(), kCar);
  ASSERT_EQ(map.num_routes(), 2U);
  EXPECT_NEAR(map.length_m(0), 2.0 * std::numbers::pi, 1e-3);
  EXPECT_EQ(map.num_cells(0), 157U);
  EXPECT_DOUBLE_EQ(map.cell_m(0) * 157.0, map.length_m(0));
}

TEST(ConflictMap, ACellsAreaCoversACarThereWithTheRoomToEachSide) {
  const road::DrivableRoute route = circle({0.0, 0.0}, 1.0);
  const ConflictMap map({&route, 1}, kCar);
  for (std::size_t cell = 0; cell < map.num_cells(0); ++cell) {
    const double angle_rad = cell_s_m(map, 0, cell) / map.length_m(0) * 2.0 * std::numbers::pi;
    // Turned into the curve by the slip, 0.045 m * 1 / m.
    const Pose pose{std::cos(angle_rad), std::sin(angle_rad),
                    angle_rad + std::numbers::pi / 2.0 - 0.045};
    EXPECT_TRUE(contains(map.area_m(0, cell), footprint_area(kCar.footprint, pose, 0.009)));
    EXPECT_FALSE(contains(map.area_m(0, cell), footprint_area(kCar.footprint, pose, 0.017)));
  }
}

TEST(ConflictMap, OverlapsAreSymmetric) {
  expect_symmetric(ConflictMap(crossing_circles(), kCar));
  expect_symmetric(ConflictMap({{figure_eight(), circle({1.0, 0.0}, 0.8, -1.0)}}, kCar));
  expect_symmetric(*lab_cars().conflicts);
}

TEST(ConflictMap, TwoCellsOverlapIfTheirAreasDo) {
  const ConflictMap& map = *lab_cars().conflicts;
  for (std::uint64_t seed = 0; seed < test::num_seeds(100000); ++seed) {
    std::mt19937_64 random(seed);
    const std::size_t a = random() % map.num_routes();
    const std::size_t b = random() % map.num_routes();
    const std::size_t i = random() % map.num_cells(a);
    const std::size_t j = random() % map.num_cells(b);
    EXPECT_EQ(std::ranges::binary_search(map.overlaps(a, i), map.cell(b, j)),
              intersects(map.area_m(a, i), map.area_m(b, j)))
        << "seed " << seed;
  }
}

void expect_apart(const std::vector<road::DrivableRoute>& routes) {
  const ConflictMap map(routes, kCar);
  EXPECT_FALSE(overlap_at_all(map, 0, 1));
  EXPECT_EQ(num_conflicts(map, 0) + num_conflicts(map, 1), 0U);
}

TEST(ConflictMap, LanesALanesWidthApartDoNotOverlap) {
  for (const double turns : {1.0, -1.0}) {
    for (std::uint64_t seed = 0; seed < test::num_seeds(10); ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 random(seed);
      const double radius_m = std::uniform_real_distribution(2.5, 4.0)(random);
      const road::DrivableRoute ring = circle({0.0, 0.0}, radius_m);
      expect_apart({ring, circle({0.0, 0.0}, radius_m + kLane_m, turns)});
      expect_apart({ring, circle({2.0 * radius_m + kLane_m, 0.0}, radius_m, turns)});
      const ConflictMap too_near({{ring, circle({0.0, 0.0}, radius_m + 0.8 * kLane_m, turns)}},
                                 kCar);
      EXPECT_TRUE(overlap_at_all(too_near, 0, 1));
    }
  }
}

TEST(ConflictMap, OnTheirDrivingLinesLanesInNarrowCurvesDoNotOverlapEither) {
  for (const double turns : {1.0, -1.0}) {
    for (std::uint64_t seed = 0; seed < test::num_seeds(10); ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      std::mt19937_64 random(seed);
      const double radius_m = std::uniform_real_distribution(0.6, 1.0)(random);
      std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, radius_m),
                                              circle({0.0, 0.0}, radius_m + kLane_m, turns)};
      EXPECT_TRUE(overlap_at_all(ConflictMap(routes, kCar), 0, 1));
      const std::vector<road::DrivingLine> lines =
          road::driving_lines({{routes[0].path, routes[1].path}}, kLane_m, kCar.footprint);
      for (std::size_t i = 0; i < 2; ++i) routes[i].driving_line = lines[i];
      expect_apart(routes);
    }
  }
}

TEST(ConflictMap, ARouteOverlapsItselfBesideTheCellOnly) {
  const road::DrivableRoute route = circle({0.0, 0.0}, 1.0);
  const ConflictMap map({&route, 1}, kCar);
  EXPECT_EQ(num_conflicts(map, 0), 0U);
  for (std::size_t i = 0; i < map.num_cells(0); ++i) {
    for (const std::size_t j : overlaps(map, 0, i, 0)) {
      EXPECT_LT(apart_m(map, 0, cell_s_m(map, 0, i), cell_s_m(map, 0, j)), 0.3);
    }
  }
}

TEST(ConflictMap, WhereRoutesCrossThereAreConflictCellsAroundTheCrossings) {
  const std::vector<road::DrivableRoute> routes = crossing_circles();
  const ConflictMap map(routes, kCar);
  for (std::size_t route = 0; route < 2; ++route) {
    const std::vector<double> crossings_m{routes[route].path.project({0.6, 0.8}).s_m,
                                          routes[route].path.project({0.6, -0.8}).s_m};
    for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
      // At 74 degrees, half the car's length and 1.3 times half its width: 0.21 m.
      const double distance_m = nearest_m(map, route, cell, crossings_m);
      if (distance_m < 0.18) {
        EXPECT_TRUE(map.is_conflict(route, cell)) << cell;
      }
      if (distance_m > 0.25) {
        EXPECT_FALSE(map.is_conflict(route, cell)) << cell;
      }
      EXPECT_EQ(map.is_conflict(route, cell), !overlaps(map, route, cell, 1 - route).empty());
    }
  }
}

TEST(ConflictMap, ARouteThatCrossesItselfIsInConflictThere) {
  const road::DrivableRoute route = figure_eight();
  const ConflictMap map({&route, 1}, kCar);
  const std::vector<double> crossings_m{0.0, map.length_m(0) / 2.0};
  for (std::size_t cell = 0; cell < map.num_cells(0); ++cell) {
    const double distance_m = nearest_m(map, 0, cell, crossings_m);
    if (distance_m < 0.16) {
      EXPECT_TRUE(map.is_conflict(0, cell)) << cell;
    }
    if (distance_m > 0.25) {
      EXPECT_FALSE(map.is_conflict(0, cell)) << cell;
    }
  }
}

TEST(ConflictMap, AlongASharedLaneThereAreNoConflictsButWhereTheRoutesMergeAndPart) {
  const std::vector<road::DrivableRoute> routes{loop_beside_lane(1.0), loop_beside_lane(-1.0)};
  const ConflictMap map(routes, kCar);
  for (std::size_t route = 0; route < 2; ++route) {
    bool is_any_before_merging = false;
    bool is_any_after_parting = false;
    for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
      const double s_m = cell_s_m(map, route, cell);
      if (s_m < 2.0) {  // the shared lane
        EXPECT_FALSE(map.is_conflict(route, cell)) << cell;
        EXPECT_FALSE(overlaps(map, route, cell, 1 - route).empty()) << "one behind the other";
      } else if (map.is_conflict(route, cell)) {
        is_any_after_parting |= s_m < 2.5;
        is_any_before_merging |= s_m > map.length_m(route) - 0.5;
        EXPECT_TRUE(s_m < 2.5 || s_m > map.length_m(route) - 0.5) << s_m;
      }
    }
    EXPECT_TRUE(is_any_before_merging && is_any_after_parting);
  }
}

/// Shares half of the ring of 2 m with it, leaves it to the outside, and joins it again where the
/// ring begins.
road::DrivableRoute joins_the_ring() {
  std::vector<Point> points_m;
  for (int i = 0; i < 720; ++i) {
    const double angle_rad = std::numbers::pi * i / 360.0;
    const double outside_m = i < 360 ? 0.0 : 0.6 * std::pow(std::sin(angle_rad), 2);
    points_m.push_back((2.0 + outside_m) * Point(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return route_along(std::move(points_m));
}

// A car that joined a lane could stop only where its tail no longer reached into the lane beside.
// Those of the lane stopped before that, one after another, and it never got through.
TEST(ConflictMap, CarsStopInTheSamePlacesBehindAMergeWhereConflictsAreShared) {
  const std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, 2.0), joins_the_ring(),
                                                circle({0.0, 0.0}, 2.0 + kLane_m, -1.0)};
  const auto last_conflict_rad = [](const ConflictMap& map, std::size_t route) {
    double last_rad = -1.0;
    for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
      const Point place_m = map.place_m(route, cell);
      const double angle_rad = std::atan2(place_m.y(), place_m.x());
      if (std::abs(angle_rad) > 1.0 || !map.is_conflict(route, cell)) continue;
      last_rad = std::max(last_rad, angle_rad);
    }
    return last_rad;
  };
  const ConflictMap map(routes, kCar);
  const double joined_rad = last_conflict_rad(map, 1);
  EXPECT_LT(last_conflict_rad(map, 0), joined_rad - 0.1) << "its tail reaches into the lane beside";
  const ConflictMap shared(routes, kCar, {.shares_conflicts = true});
  EXPECT_NEAR(last_conflict_rad(shared, 1), joined_rad, 1e-9);
  EXPECT_NEAR(last_conflict_rad(shared, 0), joined_rad, shared.cell_m(0) / 2.0);
}

// On a ring of 4 m cars of 107 mm with 16 mm to each side leave nearly 11 mm of 150 mm.
TEST(ConflictMap, NoCarStopsBesideAnotherLaneWithoutTheRoomThatStoppingNeeds) {
  const std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, 4.0),
                                                circle({0.0, 0.0}, 4.0 + kLane_m)};
  const ConflictMap map(routes, kCar, {.stopping_room_m = 0.005});
  EXPECT_EQ(num_conflicts(map, 0) + num_conflicts(map, 1), 0U);
  const ConflictMap wide(routes, kCar, {.stopping_room_m = 0.015});
  EXPECT_EQ(num_conflicts(wide, 0), wide.num_cells(0));
  EXPECT_EQ(num_conflicts(wide, 1), wide.num_cells(1));
  for (std::size_t cell = 0; cell < wide.num_cells(0); ++cell) {
    EXPECT_TRUE(std::ranges::equal(wide.overlaps(0, cell), map.overlaps(0, cell)))
        << "cars still pass each other in cell " << cell;
  }
}

TEST(ConflictMap, TheSameLaneInTheOtherDirectionIsAConflictAllAlong) {
  const ConflictMap map({{circle({0.0, 0.0}, 1.0), circle({0.0, 0.0}, 1.0, -1.0)}}, kCar);
  EXPECT_EQ(num_conflicts(map, 0), map.num_cells(0));
  EXPECT_EQ(num_conflicts(map, 1), map.num_cells(1));
}

/// As on random tours: to the left, again to the left or right, and so on, over the same lane.
std::vector<road::DrivableRoute> tours() {
  const auto tour = [](std::initializer_list<double> sides) {
    std::vector<Point> points_m;
    for (const double side : sides) {
      const road::DrivableRoute loop = loop_beside_lane(side);
      points_m.insert(points_m.end(), loop.path.points_m().begin(), loop.path.points_m().end());
    }
    return route_along(std::move(points_m));
  };
  return {tour({1, 1, -1}), tour({-1, 1, 1, -1, -1})};
}

TEST(ConflictMap, LanesThatRoutesDriveAgainAreJoined) {
  const std::vector<road::DrivableRoute> loops{loop_beside_lane(1.0), loop_beside_lane(-1.0)};
  const ConflictMap of_loops(loops, kCar, kTours);
  const ConflictMap map(tours(), kCar, kTours);
  EXPECT_LT(map.num_cells(), 2 * of_loops.num_cells());
  EXPECT_GT(map.num_cells(0) + map.num_cells(1), 3 * of_loops.num_cells());
  expect_symmetric(map);
}

TEST(ConflictMap, ToursAreInConflictWhereTheirLoopsAre) {
  const std::vector<road::DrivableRoute> loops{loop_beside_lane(1.0), loop_beside_lane(-1.0)};
  const ConflictMap of_loops(loops, kCar, {.along_m = kTours.along_m});
  const ConflictMap map(tours(), kCar, kTours);
  const auto conflicts_of_loops_near = [&](const ConvexPolygon& area_m) {
    bool is_any = false;
    bool is_all = true;
    for (std::size_t loop = 0; loop < 2; ++loop) {
      for (std::size_t cell = 0; cell < of_loops.num_cells(loop); ++cell) {
        const Point offset_m =
            area_m.vertices_m.front() - of_loops.area_m(loop, cell).vertices_m.front();
        if (offset_m.norm() > 0.09) continue;
        is_any |= of_loops.is_conflict(loop, cell);
        is_all &= of_loops.is_conflict(loop, cell);
      }
    }
    return std::pair(is_any, is_all);
  };
  for (std::size_t route = 0; route < 2; ++route) {
    for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
      const auto [is_any, is_all] = conflicts_of_loops_near(map.area_m(route, cell));
      if (is_any != is_all) continue;  // at the end of a stretch
      EXPECT_EQ(map.is_conflict(route, cell), is_any) << route << ' ' << cell;
    }
  }
}

TEST(ConflictMap, AJoinedCellLiesAtMostHalfACellFromTheRoutesPlace) {
  const std::vector<road::DrivableRoute> routes = tours();
  const ConflictMap map(routes, kCar, kTours);
  for (std::size_t route = 0; route < 2; ++route) {
    for (std::size_t cell = 0; cell < map.num_cells(route); ++cell) {
      const double s_m = cell_s_m(map, route, cell);
      const Point place_m = routes[route].path.at(s_m);
      const Pose pose{place_m.x(), place_m.y(), routes[route].path.heading_rad_at(s_m + 1e-6)};
      const ConvexPolygon car = footprint_area(kCar.footprint, pose, 0.0);
      EXPECT_TRUE(contains(map.area_m(route, cell), car, 0.012)) << route << ' ' << cell;
    }
  }
}

TEST(ConflictMap, AnEqualRouteIsNoConflict) {
  const ConflictMap map({{circle({0.0, 0.0}, 1.0), circle({0.0, 0.0}, 1.0)}}, kCar);
  EXPECT_EQ(num_conflicts(map, 0) + num_conflicts(map, 1), 0U);
  EXPECT_EQ(overlaps(map, 0, 5, 1).size(), overlaps(map, 0, 5, 0).size());
}

}  // namespace
}  // namespace hlc::right_of_way
