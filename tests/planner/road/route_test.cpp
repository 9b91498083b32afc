#include "planner/road/route.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "planner/geometry/cross.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/road/lab_like_map.hpp"
#include "tests/support/folders.hpp"

namespace hlc::road {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A straight lane along x of width 0.2 m with points 0.1 m apart.
Lanelet straight(LaneletId id, double from_x_m, double to_x_m, double middle_y_m) {
  Lanelet lanelet;
  lanelet.id = id;
  const double n = std::round((to_x_m - from_x_m) / 0.1);
  for (double i = 0.0; i <= n; ++i) {
    const double x = from_x_m + (to_x_m - from_x_m) * i / n;
    lanelet.left_m.emplace_back(x, middle_y_m + 0.1);
    lanelet.right_m.emplace_back(x, middle_y_m - 0.1);
  }
  return lanelet;
}

LaneletMap map_of(const std::vector<Lanelet>& lanelets) {
  LaneletMap map;
  for (const Lanelet& lanelet : lanelets) {
    map.lanelets.emplace(lanelet.id, lanelet);
  }
  return map;
}

std::string error_of(const LaneletMap& map, const std::vector<LaneletId>& ids, bool closed) {
  try {
    (void)build_route(map, ids, closed);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// True if the two pieces cross in their interiors.
bool cross_each_other(const Segment& a, const Segment& b) {
  const Point along_a = a.to_m - a.from_m;
  const Point along_b = b.to_m - b.from_m;
  return cross(along_a, b.from_m - a.from_m) * cross(along_a, b.to_m - a.from_m) < 0.0 &&
         cross(along_b, a.from_m - b.from_m) * cross(along_b, a.to_m - b.from_m) < 0.0;
}

/// True if the boundary near s runs between the path's point at s and `point`.
bool separated(const Route& route, double s_m, const Point& point) {
  const Segment sight{.from_m = route.path.at(s_m), .to_m = point};
  for (const Segment& piece : route.corridor.boundary_m(s_m - 0.3, s_m + 0.3)) {
    if (cross_each_other(sight, piece)) {
      return true;
    }
  }
  return false;
}

TEST(Route, RunsThroughTheCentreLinesWithEachJointOnce) {
  const Route route =
      build_route(map_of({straight(1, 0.0, 1.0, 0.0), straight(2, 1.0, 1.5, 0.0)}), {1, 2}, false);
  EXPECT_NEAR(route.path.length_m(), 1.5, 1e-12);
  EXPECT_EQ(route.path.points_m().size(), 16U);
  EXPECT_FALSE(route.path.is_closed());
  ASSERT_EQ(route.lanelet_s_m.size(), 3U);
  EXPECT_NEAR(route.lanelet_s_m[1], 1.0, 1e-12);
  EXPECT_NEAR(route.lanelet_s_m[2], 1.5, 1e-12);
}

TEST(Route, GapOfFiveMillimetresIsClosedAndALargerOneIsRefused) {
  const Lanelet first = straight(1, 0.0, 1.0, 0.0);
  EXPECT_NEAR(
      build_route(map_of({first, straight(2, 1.0049, 1.5, 0.0)}), {1, 2}, false).path.length_m(),
      1.5, 1e-12);
  EXPECT_THAT(error_of(map_of({first, straight(2, 1.006, 1.5, 0.0)}), {1, 2}, false),
              AllOf(HasSubstr("from the end of lanelet 1 to the begin of lanelet 2 = 6.0 mm"),
                    HasSubstr("must be <= 5.0 mm")));
}

TEST(Route, CircuitMustClose) {
  // There and back again: the lanes of opposite direction lie in each other.
  Lanelet back = straight(2, 0.0, 1.0, 0.0);
  std::reverse(back.left_m.begin(), back.left_m.end());
  std::reverse(back.right_m.begin(), back.right_m.end());
  std::swap(back.left_m, back.right_m);
  const LaneletMap map = map_of({straight(1, 0.0, 1.0, 0.0), back});
  const Route route = build_route(map, {1, 2}, true);
  EXPECT_TRUE(route.path.is_closed());
  EXPECT_NEAR(route.path.length_m(), 2.0, 1e-12);
  EXPECT_THAT(error_of(map, {1}, true), HasSubstr("to the begin of lanelet 1 = 1000.0 mm"));
}

TEST(Route, RefusesUnknownLaneletsAndEmptyRoutes) {
  const LaneletMap map = map_of({straight(1, 0.0, 1.0, 0.0)});
  EXPECT_THAT(error_of(map, {1, 12}, false), HasSubstr("lanelet 12 is not in the map"));
  EXPECT_THAT(error_of(map, {}, false), HasSubstr("at least 1"));
}

TEST(Route, RefusesLaneletWithoutLength) {
  Lanelet point = straight(1, 0.0, 1.0, 0.0);
  point.left_m = {Point(0.0, 0.1), Point(0.0, 0.1)};
  point.right_m = {Point(0.0, -0.1), Point(0.0, -0.1)};
  EXPECT_THAT(error_of(map_of({point}), {1}, false), HasSubstr("lanelet 1 has no length"));
}

TEST(Route, NeighboursOfNeighboursAreDrivableAndOppositeLanesAreNot) {
  Lanelet middle = straight(1, 0.0, 1.0, 0.0);
  Lanelet left = straight(2, 0.0, 1.0, 0.2);
  Lanelet leftmost = straight(3, 0.0, 1.0, 0.4);
  middle.adjacent_left = {2, true};
  left.adjacent_left = {3, true};
  leftmost.adjacent_left = {4, false};
  middle.adjacent_right = {5, false};
  const LaneletMap map =
      map_of({middle, left, leftmost, straight(4, 0.0, 1.0, 0.6), straight(5, 0.0, 1.0, -0.2)});
  const Route route = build_route(map, {1}, false);
  EXPECT_FALSE(separated(route, 0.55, Point(0.55, 0.49)));
  EXPECT_TRUE(separated(route, 0.55, Point(0.55, 0.51)));
  EXPECT_FALSE(separated(route, 0.55, Point(0.55, -0.09)));
  EXPECT_TRUE(separated(route, 0.55, Point(0.55, -0.11)));
}

TEST(Route, ShorterNeighbourIsDrivableAsFarAsItReaches) {
  Lanelet lane = straight(1, 0.0, 2.0, 0.0);
  lane.adjacent_left = {2, true};
  const LaneletMap map = map_of(
      {straight(8, -1.0, 0.0, 0.0), lane, straight(2, 0.5, 1.5, 0.2), straight(9, 2.0, 3.0, 0.0)});
  const Route route = build_route(map, {8, 1, 9}, false);
  EXPECT_FALSE(separated(route, 1.75, Point(0.75, 0.29)));
  EXPECT_TRUE(separated(route, 1.75, Point(0.75, 0.31)));
  EXPECT_TRUE(separated(route, 1.05, Point(0.05, 0.2)));
  EXPECT_TRUE(separated(route, 2.95, Point(1.95, 0.2)));
  for (double x = -0.95; x < 3.0; x += 0.1) {
    EXPECT_FALSE(separated(route, x + 1.0, Point(x, 0.09))) << x;
    EXPECT_TRUE(separated(route, x + 1.0, Point(x, 0.5))) << x;
  }
}

TEST(Route, PieceClosesTheStepWhereANeighbourBeginsOrEnds) {
  Lanelet lane = straight(1, 0.0, 1.0, 0.0);
  lane.adjacent_right = {2, true};
  const LaneletMap map = map_of(
      {straight(8, -1.0, 0.0, 0.0), lane, straight(2, 0.0, 1.0, -0.2), straight(9, 1.0, 2.0, 0.0)});
  const Route route = build_route(map, {8, 1, 9}, false);
  for (const double x : {0.0, 1.0}) {
    const Segment along{.from_m = Point(x - 0.01, -0.2), .to_m = Point(x + 0.01, -0.2)};
    int crossed = 0;
    for (const Segment& piece : route.corridor.boundary_m(1.0 + x, 1.0 + x)) {
      crossed += cross_each_other(along, piece) ? 1 : 0;
    }
    EXPECT_EQ(crossed, 1) << x;
  }
}

TEST(Route, BareLaneTakesTheLanesThatMergeWithItOrForkFromItBesideIt) {
  // Two lanes become one and two again; the right one has no neighbour where they run together.
  Lanelet merging = straight(2, 0.0, 1.0, 0.0);
  for (std::size_t i = 0; i < merging.left_m.size(); ++i) {
    const Point shift(0.0, 0.2 * (1.0 - static_cast<double>(i) / 10.0));
    merging.left_m[i] += shift;
    merging.right_m[i] += shift;
  }
  Lanelet forking = straight(4, 1.0, 2.0, 0.0);
  for (std::size_t i = 0; i < forking.left_m.size(); ++i) {
    const Point shift(0.0, 0.02 * static_cast<double>(i));
    forking.left_m[i] += shift;
    forking.right_m[i] += shift;
  }
  merging.adjacent_left = {5, true};
  Lanelet outermost = merging;
  outermost.id = 5;
  outermost.adjacent_left.reset();
  for (Point& point : outermost.left_m) {
    point.y() += 0.1;
  }
  Lanelet bare = straight(1, 0.0, 1.0, 0.0);
  const Lanelet after = straight(3, 1.0, 2.0, 0.0);
  const Route route =
      build_route(map_of({bare, merging, after, forking, outermost}), {1, 3}, false);
  EXPECT_FALSE(separated(route, 0.55, Point(0.55, 0.28)));
  EXPECT_TRUE(separated(route, 0.55, Point(0.55, 0.30)));
  EXPECT_FALSE(separated(route, 1.55, Point(1.55, 0.20)));
  EXPECT_TRUE(separated(route, 1.55, Point(1.55, 0.22)));
  EXPECT_TRUE(separated(route, 0.55, Point(0.55, -0.11)));

  bare.adjacent_right = {6, true};  // no longer bare: its neighbours are those that the map names
  const Route wider =
      build_route(map_of({bare, merging, after, forking, outermost, straight(6, 0.0, 1.0, -0.2)}),
                  {1, 3}, false);
  EXPECT_TRUE(separated(wider, 0.55, Point(0.55, 0.11)));
  EXPECT_FALSE(separated(wider, 0.55, Point(0.55, -0.29)));
}

TEST(Route, NeighboursInACircleEnd) {
  Lanelet a = straight(1, 0.0, 1.0, 0.0);
  Lanelet b = straight(2, 0.0, 1.0, 0.2);
  a.adjacent_left = {2, true};
  b.adjacent_left = {1, true};
  EXPECT_FALSE(build_route(map_of({a, b}), {1}, false).corridor.pieces().empty());
}

// --- the circuits that the paper's scenario drives, on the lab's map and on ours -----------------

struct Circuits {
  RoadNetwork network;
  std::vector<double> length_m;
  /// Lanes without a neighbour, and the lane left of them that merges with them or forks from them.
  std::map<LaneletId, LaneletId> merging_or_forking;
};

Circuits lab_like_circuits() {
  return {lab_like_map(), {12.226, 9.226, 8.882}, {{12, 4}, {14, 33}, {16, 5}, {19, 35}}};
}

/// Without lanelets if the lab's map is not here.
Circuits lab_circuits() {
  Circuits lab{{}, {12.219, 9.225, 8.880}, {{75, 57}, {101, 83}, {74, 55}, {22, 3}}};
  const auto file =
      std::filesystem::path(test::source_folder()) / "../shared/data/LabMapCommonRoad.xml";
  if (std::filesystem::exists(file)) {
    lab.network.map = read_lanelet_map(file);
    lab.network.routes = {
        {"red", {41, 39, 20, 63, 61, 57, 55, 67, 65, 98, 37, 35, 31, 29}},
        {"blue", {64, 62, 75, 55, 53, 79, 81, 101, 88, 90, 95, 69}},
        {"green", {5, 7, 59, 57, 74, 68, 66, 71, 19, 14, 16, 22}},
    };
  }
  return lab;
}

class Circuit : public ::testing::TestWithParam<Circuits (*)()> {
 protected:
  void SetUp() override {
    if (circuits_.network.map.lanelets.empty()) {
      GTEST_SKIP() << "../shared/data/LabMapCommonRoad.xml is not here";
    }
    for (const NamedRoute& named : circuits_.network.routes) {
      routes_.push_back(build_route(circuits_.network.map, named.lanelets, true));
    }
  }

  const LaneletMap& map() const { return circuits_.network.map; }

  /// The lanes that are drivable on this lanelet of a route, from the leftmost to the rightmost.
  std::vector<LaneletId> drivable_beside(LaneletId id) const {
    std::vector<LaneletId> lanes{id};
    const auto beside = circuits_.merging_or_forking.find(id);
    if (beside != circuits_.merging_or_forking.end()) {
      lanes.insert(lanes.begin(), beside->second);
    }
    while (const auto& left = map().lanelets.at(lanes.front()).adjacent_left) {
      if (!left->same_direction) {
        break;
      }
      lanes.insert(lanes.begin(), left->id);
    }
    while (const auto& right = map().lanelets.at(lanes.back()).adjacent_right) {
      if (!right->same_direction) {
        break;
      }
      lanes.push_back(right->id);
    }
    return lanes;
  }

  Circuits circuits_ = GetParam()();
  std::vector<Route> routes_;
};

TEST_P(Circuit, HasTheKnownLength) {
  for (std::size_t r = 0; r < routes_.size(); ++r) {
    EXPECT_NEAR(routes_[r].path.length_m(), circuits_.length_m[r], 0.005);
    EXPECT_EQ(routes_[r].lanelet_s_m.back(), routes_[r].path.length_m());
  }
}

TEST_P(Circuit, InteriorOfItsLanesAndNeighboursIsDrivable) {
  for (const Route& route : routes_) {
    for (std::size_t i = 0; i < route.lanelets.size(); ++i) {
      for (const LaneletId id : drivable_beside(route.lanelets[i])) {
        const Lanelet& lane = map().lanelets.at(id);
        for (std::size_t j = 0; j + 1 < lane.left_m.size(); ++j) {
          const Point left = (lane.left_m[j] + lane.left_m[j + 1]) / 2.0;
          const Point right = (lane.right_m[j] + lane.right_m[j + 1]) / 2.0;
          for (const double w : {0.02, 0.2, 0.5, 0.8, 0.98}) {
            const Point sample = (1.0 - w) * left + w * right;
            const double s_m =
                route.path.project_within(sample, route.lanelet_s_m[i], route.lanelet_s_m[i + 1])
                    .s_m;
            EXPECT_FALSE(separated(route, s_m, sample))
                << "lanelet " << id << " at s = " << s_m << ", point " << sample.transpose();
          }
        }
      }
    }
  }
}

TEST_P(Circuit, OwnLaneIsDrivableEverywhere) {
  for (const Route& route : routes_) {
    for (double s_m = 0.0; s_m < route.path.length_m(); s_m += 0.01) {
      const double heading = route.path.heading_rad_at(s_m);
      for (const double left_m : {-0.07, 0.07}) {
        const Point sample =
            route.path.at(s_m) + left_m * Point(-std::sin(heading), std::cos(heading));
        EXPECT_FALSE(separated(route, s_m, sample)) << s_m << ", " << left_m;
      }
    }
  }
}

TEST_P(Circuit, PointsBeyondTheOutermostLanesAreNotDrivable) {
  for (const Route& route : routes_) {
    for (std::size_t i = 0; i < route.lanelets.size(); ++i) {
      const std::vector<LaneletId> lanes = drivable_beside(route.lanelets[i]);
      for (const bool on_left : {true, false}) {
        const LaneletId id = on_left ? lanes.front() : lanes.back();
        const Lanelet& lane = map().lanelets.at(id);
        const std::vector<Point>& bound = on_left ? lane.left_m : lane.right_m;
        for (std::size_t j = 0; j + 1 < bound.size(); ++j) {
          const Point along = (bound[j + 1] - bound[j]).normalized();
          const Point outside = (bound[j] + bound[j + 1]) / 2.0 +
                                (on_left ? 0.01 : -0.01) * Point(-along.y(), along.x());
          const double s_m =
              route.path.project_within(outside, route.lanelet_s_m[i], route.lanelet_s_m[i + 1])
                  .s_m;
          EXPECT_TRUE(separated(route, s_m, outside))
              << "lanelet " << id << " at s = " << s_m << ", point " << outside.transpose();
        }
      }
    }
  }
}

TEST_P(Circuit, BoundaryIsTwoClosedLines) {
  for (const Route& route : routes_) {
    int begins = 0;
    const auto& pieces = route.corridor.pieces();
    Point line_begin = pieces.front().segment.from_m;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Point& end = pieces[i].segment.to_m;
      if (i + 1 == pieces.size() || (pieces[i + 1].segment.from_m - end).norm() > 1e-5) {
        EXPECT_NEAR((end - line_begin).norm(), 0.0, 1e-5);
        ++begins;
        line_begin = i + 1 == pieces.size() ? end : pieces[i + 1].segment.from_m;
      }
      EXPECT_LT(pieces[i].to_s_m - pieces[i].from_s_m, 0.4);
    }
    EXPECT_EQ(begins, 2);
  }
}

constexpr Footprint kCar{.length_m = 0.22, .width_m = 0.107};
constexpr double kHalfWheelbase_m = 0.075;

void expect_no_boundary_crossed(const Route& route, double s_m, const Pose& pose) {
  const ConvexPolygon area = footprint_area(kCar, pose);
  for (const Segment& piece : route.corridor.boundary_m(s_m - 0.3, s_m + 0.3)) {
    EXPECT_FALSE(intersects(area, piece)) << "s = " << s_m << ", piece " << piece.from_m.transpose()
                                          << " to " << piece.to_m.transpose();
  }
}

TEST_P(Circuit, FootprintAlongTheCentreLineCrossesNoBoundary) {
  for (const Route& route : routes_) {
    for (double s_m = 0.0; s_m < route.path.length_m(); s_m += 0.01) {
      const Point position = route.path.at(s_m);
      const Point along =
          route.path.at(s_m + kHalfWheelbase_m) - route.path.at(s_m - kHalfWheelbase_m);
      expect_no_boundary_crossed(route, s_m,
                                 {.x_m = position.x(),
                                  .y_m = position.y(),
                                  .heading_rad = std::atan2(along.y(), along.x())});
    }
  }
}

TEST_P(Circuit, SteeredCarCanDriveARound) {
  // A car moves along its heading at the rear axle, so in a bend its nose points outwards and it
  // needs more room than its width. This one is pulled along the centre line by a point 25 mm
  // before its middle.
  constexpr double kPulled_m = 0.1;  // before the rear axle
  for (const Route& route : routes_) {
    Point rear = route.path.at(-1.0 - kPulled_m);
    for (double s_m = -1.0; s_m < route.path.length_m(); s_m += 0.002) {
      const Point along = (route.path.at(s_m) - rear).normalized();
      rear = route.path.at(s_m) - kPulled_m * along;
      const Point middle = rear + kHalfWheelbase_m * along;
      if (s_m >= 0.0) {
        expect_no_boundary_crossed(route, s_m,
                                   {.x_m = middle.x(),
                                    .y_m = middle.y(),
                                    .heading_rad = std::atan2(along.y(), along.x())});
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, Circuit, ::testing::Values(&lab_circuits, &lab_like_circuits),
                         [](const auto& map) { return map.index == 0 ? "Lab" : "LabLike"; });

}  // namespace
}  // namespace hlc::road
