#include "planner/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "planner/geometry/cross.hpp"
#include "planner/geometry/intersection.hpp"

namespace hlc {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Point random_point(Random& random, double size_m = 1.0) {
  return {uniform(random, -size_m, size_m), uniform(random, -size_m, size_m)};
}

/// Hull of random points: 3 to about 20 vertices, of very different sizes.
ConvexPolygon random_polygon(Random& random, const Point& centre_m = Point::Zero()) {
  const int size = 3 + static_cast<int>(random() % 40U);
  const double stretch = std::pow(10.0, uniform(random, -2.0, 0.0));
  std::vector<Point> points;
  for (int i = 0; i < size; ++i) {
    const Point p = random_point(random);
    points.push_back(centre_m + Point(p.x(), stretch * p.y()));
  }
  return transformed(convex_hull(points), {0.0, 0.0, uniform(random, -3.0, 3.0)});
}

/// Random point of the polygon: a convex combination of its vertices, often near a vertex or edge.
Point random_point_of(const ConvexPolygon& polygon, Random& random) {
  Point point = Point::Zero();
  double sum = 0.0;
  for (const Point& vertex : polygon.vertices_m) {
    const double weight = std::pow(uniform(random, 0.0, 1.0), 20.0);
    point += weight * vertex;
    sum += weight;
  }
  return point / sum;
}

/// Length of the part of a segment inside a polygon, by cutting it along every edge (Cyrus, Beck).
double common_length_m(const Segment& segment, const ConvexPolygon& window) {
  double low = 0.0;
  double high = 1.0;
  const Point direction = segment.to_m - segment.from_m;
  for (std::size_t i = 0; i < window.vertices_m.size(); ++i) {
    const Point& from = window.vertices_m[i];
    const Point edge = window.vertices_m[(i + 1) % window.vertices_m.size()] - from;
    const double start = cross(edge, segment.from_m - from);
    const double slope = cross(edge, direction);
    if (slope > 0.0) {
      low = std::max(low, -start / slope);
    } else if (slope < 0.0) {
      high = std::min(high, -start / slope);
    } else if (start < 0.0) {
      return 0.0;
    }
  }
  return std::max(0.0, high - low) * direction.norm();
}

void expect_strictly_convex(const ConvexPolygon& polygon) {
  const auto& v = polygon.vertices_m;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Point& a = v[i];
    const Point& b = v[(i + 1) % v.size()];
    const Point& c = v[(i + 2) % v.size()];
    EXPECT_GT(cross(b - a, c - b), 0.0) << "at vertex " << i;
  }
}

const ConvexPolygon kSquare{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};

TEST(ConvexHull, OfAGridAreItsFourCorners) {
  std::vector<Point> points;
  for (int x = 0; x <= 10; ++x) {
    for (int y = 0; y <= 10; ++y) {
      points.insert(points.end(), 2, Point(0.1 * x, 0.1 * y));
    }
  }
  const ConvexPolygon hull = convex_hull(points);
  EXPECT_EQ(hull, (ConvexPolygon{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}));
}

TEST(ConvexHull, HoldsAllPointsAndIsStrictlyConvexAlsoWithDuplicatesAndCollinearPoints) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 500; ++run) {
    std::vector<Point> points;
    for (int i = 0; i < 20; ++i) {
      points.push_back(random_point(random));
    }
    for (int i = 0; i < 20; ++i) {  // on the lines between earlier ones, ends included
      const Point& a = points[random() % points.size()];
      const Point& b = points[random() % points.size()];
      points.push_back(a + 0.25 * static_cast<double>(random() % 5U) * (b - a));
    }
    const ConvexPolygon hull = convex_hull(points);
    expect_strictly_convex(hull);
    for (const Point& point : points) {
      EXPECT_TRUE(contains(hull, point, 10.0 * kHullTolerance_m));
    }
    for (const Point& vertex : hull.vertices_m) {
      EXPECT_NE(std::find(points.begin(), points.end(), vertex), points.end());
    }
  }
}

TEST(ConvexHull, OfPointsOnALineIsEmptyButItsEndsAreKnown) {
  const std::vector<Point> points{{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.2}, {0.1, 0.1}};
  EXPECT_TRUE(convex_hull(points).empty());
  EXPECT_EQ(hull_vertices(points), (std::vector<Point>{{0.1, 0.1}, {0.3, 0.3}}));
  EXPECT_EQ(hull_vertices({{0.1, 0.2}, {0.1, 0.2}}), (std::vector<Point>{{0.1, 0.2}}));
  EXPECT_TRUE(hull_vertices({}).empty());
}

// Corners that stand above each other but for the last bits of x, in any order.
TEST(ConvexHull, HoldsPointsWhoseXDifferByRoundingOnly) {
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    std::vector<Point> points{{0.0, 0.0}};
    for (int i = 0; i < 5; ++i) {
      const double ulps = std::floor(uniform(random, 0.0, 3.0));
      points.emplace_back(1.0 - ulps * 0x1p-53, uniform(random, -0.3, 0.3));
    }
    const std::vector<Point> hull = hull_vertices(points);
    ASSERT_GE(hull.size(), 3U) << "seed " << seed;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point edge = hull[(i + 1) % hull.size()] - hull[i];
      for (const Point& point : points) {
        ASSERT_GE(cross(edge, point - hull[i]), -2.0 * kHullTolerance_m * edge.norm())
            << "seed " << seed;
      }
    }
  }
}

TEST(Polygon, TransformedMovesEveryVertexAsAPoint) {
  const Pose frame{1.0, -2.0, 0.7};
  const ConvexPolygon moved = transformed(kSquare, frame);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(moved.vertices_m[i], transformed(kSquare.vertices_m[i], frame));
  }
}

TEST(Inflated, HoldsEveryPointWithinTheDistance) {
  constexpr unsigned kSeed = 12;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 300; ++run) {
    const ConvexPolygon polygon = random_polygon(random);
    const double distance = std::pow(10.0, uniform(random, -6.0, 0.0));
    const ConvexPolygon larger = inflated(polygon, distance);
    for (int i = 0; i < 100; ++i) {
      const double angle = uniform(random, -4.0, 4.0);
      const Point near =
          random_point_of(polygon, random) + distance * Point(std::cos(angle), std::sin(angle));
      EXPECT_TRUE(contains(larger, near)) << "distance " << distance;
    }
  }
}

TEST(Inflated, MovesEveryEdgeByTheDistanceAndNoMore) {
  constexpr unsigned kSeed = 13;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 300; ++run) {
    const ConvexPolygon polygon = random_polygon(random);
    const ConvexPolygon larger = inflated(polygon, 0.1);
    const auto& v = polygon.vertices_m;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Point edge = v[(i + 1) % v.size()] - v[i];
      const Point outwards = Point(edge.y(), -edge.x()).normalized();
      const Point middle = v[i] + 0.5 * edge;
      EXPECT_TRUE(contains(larger, middle + 0.1 * outwards));
      EXPECT_FALSE(contains(larger, middle + 0.1001 * outwards));
    }
  }
}

TEST(Inflated, StaysFiniteAndCloseAtTheTipOfANeedle) {
  const ConvexPolygon needle{{{0.0, 0.0}, {1.0, 0.0}, {0.5, 1e-11}}};
  const ConvexPolygon larger = inflated(needle, 0.1);
  const Box box = bounding_box(larger);
  EXPECT_NEAR(box.min_m.x(), -0.1, 1e-9);
  EXPECT_NEAR(box.max_m.x(), 1.1, 1e-9);
  EXPECT_NEAR(box.min_m.y(), -0.1, 1e-9);
  EXPECT_NEAR(box.max_m.y(), 0.1, 1e-9);
  EXPECT_TRUE(inflated(ConvexPolygon{}, 0.1).empty());
}

TEST(SimplifiedOutwards, HoldsThePolygonWithAtMostSoManyVertices) {
  constexpr unsigned kSeed = 14;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 300; ++run) {
    const ConvexPolygon polygon = random_polygon(random);
    for (const std::size_t max_vertices : {4U, 5U, 8U, 12U}) {
      const ConvexPolygon simple = simplified_outwards(polygon, max_vertices);
      EXPECT_LE(simple.vertices_m.size(), max_vertices);
      for (const Point& vertex : polygon.vertices_m) {
        EXPECT_TRUE(contains(simple, vertex));
      }
    }
  }
}

TEST(SimplifiedOutwards, EveryEdgeTouchesThePolygon) {
  constexpr unsigned kSeed = 15;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 300; ++run) {
    const ConvexPolygon polygon = random_polygon(random);
    const ConvexPolygon simple = simplified_outwards(polygon, 5);
    const auto& v = simple.vertices_m;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Point edge = v[(i + 1) % v.size()] - v[i];
      double nearest = std::numeric_limits<double>::infinity();
      for (const Point& vertex : polygon.vertices_m) {
        nearest = std::min(nearest, cross(edge, vertex - v[i]) / edge.norm());
      }
      EXPECT_LT(nearest, 1e-11);
    }
  }
}

TEST(SimplifiedOutwards, RemovesTheEdgeThatAddsLeastArea) {
  // A square with three corners cut off by 0.1, 0.2 and 0.3: the smallest cuts are filled first.
  const ConvexPolygon polygon = convex_hull(
      {{0.0, 0.0}, {0.9, 0.0}, {1.0, 0.1}, {1.0, 0.8}, {0.8, 1.0}, {0.3, 1.0}, {0.0, 0.7}});
  ASSERT_EQ(polygon.vertices_m.size(), 7U);
  EXPECT_NEAR(area_m2(simplified_outwards(polygon, 6)), 1.0 - 0.02 - 0.045, 1e-9);
  EXPECT_NEAR(area_m2(simplified_outwards(polygon, 5)), 1.0 - 0.045, 1e-9);
  EXPECT_NEAR(area_m2(simplified_outwards(polygon, 4)), 1.0, 1e-9);
  EXPECT_EQ(simplified_outwards(polygon, 7), polygon);
}

TEST(Contains, CountsTheBorderAndTheTolerance) {
  EXPECT_TRUE(contains(kSquare, {0.5, 0.5}));
  EXPECT_TRUE(contains(kSquare, {1.0, 0.5}));
  EXPECT_TRUE(contains(kSquare, {1.0, 1.0}));
  EXPECT_FALSE(contains(kSquare, {1.0 + 1e-9, 0.5}));
  EXPECT_TRUE(contains(kSquare, {1.0 + 1e-9, 0.5}, 2e-9));
  EXPECT_FALSE(contains(kSquare, {-0.1, 0.5}, 0.05));
  EXPECT_FALSE(contains(ConvexPolygon{}, {0.0, 0.0}, 1.0));
}

TEST(Contains, APolygonIsInsideIfAllItsCornersAre) {
  int inside = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const ConvexPolygon polygon = random_polygon(random);
    ConvexPolygon other = random_polygon(random, random_point_of(polygon, random));
    const double scale = std::pow(10.0, uniform(random, -3.0, 0.0));
    const Point centre_m = other.vertices_m.front();
    for (Point& corner : other.vertices_m) corner = centre_m + scale * (corner - centre_m);
    for (const double tolerance_m : {0.0, 0.1}) {
      const bool expected = std::ranges::all_of(other.vertices_m, [&](const Point& corner) {
        return contains(polygon, corner, tolerance_m);
      });
      EXPECT_EQ(contains(polygon, other, tolerance_m), expected);
      inside += expected ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_TRUE(contains(kSquare, ConvexPolygon{}));
  EXPECT_FALSE(contains(ConvexPolygon{}, kSquare));
}

TEST(Intersects, AgreesWithTheAreaThatTwoPolygonsShare) {
  constexpr unsigned kSeed = 16;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  int num_intersecting = 0;
  for (int run = 0; run < 5000; ++run) {
    const ConvexPolygon a = random_polygon(random);
    const ConvexPolygon b = random_polygon(random, random_point(random, 2.0));
    const bool expected = area_m2(intersection(a, b)) > 0.0;
    EXPECT_EQ(intersects(a, b), expected) << "run " << run;
    EXPECT_EQ(intersects(b, a), expected) << "run " << run;
    num_intersecting += expected ? 1 : 0;
  }
  EXPECT_GT(num_intersecting, 1000);
  EXPECT_LT(num_intersecting, 4000);
}

TEST(Intersects, AgreesWithTheLengthThatASegmentSharesWithAPolygon) {
  constexpr unsigned kSeed = 17;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  int num_intersecting = 0;
  for (int run = 0; run < 5000; ++run) {
    const ConvexPolygon polygon = random_polygon(random);
    const Segment segment{random_point(random, 2.0), random_point(random, 2.0)};
    const bool expected = common_length_m(segment, polygon) > 0.0;
    EXPECT_EQ(intersects(polygon, segment), expected) << "run " << run;
    num_intersecting += expected ? 1 : 0;
  }
  EXPECT_GT(num_intersecting, 1000);
  EXPECT_LT(num_intersecting, 4000);
}

TEST(Intersects, WhatOnlyTouchesDoesNotIntersect) {
  const ConvexPolygon right{{{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}}};
  const ConvexPolygon diagonal{{{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}};
  EXPECT_FALSE(intersects(kSquare, right));
  EXPECT_FALSE(intersects(kSquare, diagonal));
  EXPECT_FALSE(intersects(kSquare, Segment{{0.0, 0.0}, {1.0, 0.0}}));
  EXPECT_FALSE(intersects(kSquare, Segment{{1.0, 0.5}, {2.0, 0.5}}));
  EXPECT_FALSE(intersects(kSquare, Segment{{0.0, 2.0}, {2.0, 0.0}}));
  EXPECT_TRUE(intersects(kSquare, Segment{{0.0, 2.0 - 1e-9}, {2.0, -1e-9}}));
}

TEST(Intersects, APolygonIntersectsItselfAndWhatLiesInside) {
  const ConvexPolygon inner{{{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}}};
  EXPECT_TRUE(intersects(kSquare, kSquare));
  EXPECT_TRUE(intersects(kSquare, inner));
  EXPECT_TRUE(intersects(inner, kSquare));
  EXPECT_TRUE(intersects(kSquare, Segment{{0.4, 0.4}, {0.6, 0.6}}));
  EXPECT_TRUE(intersects(kSquare, Segment{{0.5, 0.5}, {0.5, 0.5}}));
  EXPECT_FALSE(intersects(kSquare, Segment{{1.5, 0.5}, {1.5, 0.5}}));
}

TEST(Intersects, ACornerThatComesTwiceHidesNothing) {
  for (std::size_t twice = 0; twice < kSquare.vertices_m.size(); ++twice) {
    ConvexPolygon square = kSquare;
    square.vertices_m.insert(square.vertices_m.begin() + static_cast<std::ptrdiff_t>(twice),
                             square.vertices_m[twice]);
    EXPECT_TRUE(intersects(square, kSquare)) << "corner " << twice;
    EXPECT_TRUE(intersects(kSquare, square)) << "corner " << twice;
    EXPECT_TRUE(intersects(square, Segment{{0.4, 0.4}, {0.6, 0.6}})) << "corner " << twice;
    EXPECT_FALSE(intersects(square, Segment{{1.5, 0.5}, {1.5, 0.6}})) << "corner " << twice;
  }
}

TEST(Intersects, TheEmptyPolygonIntersectsNothing) {
  EXPECT_FALSE(intersects(kSquare, ConvexPolygon{}));
  EXPECT_FALSE(intersects(ConvexPolygon{}, kSquare));
  EXPECT_FALSE(intersects(ConvexPolygon{}, ConvexPolygon{}));
  EXPECT_FALSE(intersects(ConvexPolygon{}, Segment{{0.0, 0.0}, {1.0, 1.0}}));
  EXPECT_FALSE(overlap(bounding_box(ConvexPolygon{}), bounding_box(kSquare)));
}

TEST(Intersects, NeedsOverlappingBoxes) {
  constexpr unsigned kSeed = 18;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 2000; ++run) {
    const ConvexPolygon a = random_polygon(random);
    const ConvexPolygon b = random_polygon(random, random_point(random, 2.0));
    const Segment segment{random_point(random, 2.0), random_point(random, 2.0)};
    EXPECT_TRUE(!intersects(a, b) || overlap(bounding_box(a), bounding_box(b)));
    EXPECT_TRUE(!intersects(a, segment) || overlap(bounding_box(a), bounding_box(segment)));
  }
}

TEST(Distance, IsThatOfTheNearestPointsOfBothBorders) {
  constexpr unsigned kSeed = 19;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int run = 0; run < 100; ++run) {
    const ConvexPolygon a = random_polygon(random);
    const ConvexPolygon b = random_polygon(random, random_point(random, 3.0));
    const double distance = distance_m(a, b);
    EXPECT_EQ(distance, distance_m(b, a));
    if (intersects(a, b)) {
      EXPECT_EQ(distance, 0.0);
      continue;
    }
    // Points of the borders: none nearer, and some as near up to their spacing.
    constexpr int kPieces = 100;
    double sampled = std::numeric_limits<double>::infinity();
    const auto border = [](const ConvexPolygon& polygon) {
      std::vector<Point> points;
      const auto& v = polygon.vertices_m;
      for (std::size_t i = 0; i < v.size(); ++i) {
        for (int piece = 0; piece < kPieces; ++piece) {
          points.emplace_back(v[i] + piece / static_cast<double>(kPieces) *
                                         (v[(i + 1) % v.size()] - v[i]));
        }
      }
      return points;
    };
    const std::vector<Point> border_b = border(b);
    for (const Point& p : border(a)) {
      for (const Point& q : border_b) {
        sampled = std::min(sampled, (p - q).norm());
      }
    }
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance, sampled - 3.0 / kPieces);
  }
}

TEST(Distance, HasTheKnownValues) {
  const ConvexPolygon right{{{1.5, 0.2}, {2.0, 0.2}, {2.0, 0.4}, {1.5, 0.4}}};
  EXPECT_DOUBLE_EQ(distance_m(kSquare, right), 0.5);
  const ConvexPolygon diagonal{{{1.3, 1.4}, {2.0, 1.4}, {2.0, 2.0}}};
  EXPECT_DOUBLE_EQ(distance_m(kSquare, diagonal), 0.5);
  EXPECT_EQ(distance_m(kSquare, kSquare), 0.0);
  EXPECT_TRUE(std::isinf(distance_m(kSquare, ConvexPolygon{})));
}

TEST(Polygon, IntersectionHoldsThePointsOfBoth) {
  Random random(21);
  std::size_t num_shared = 0;
  for (int i = 0; i < 2000; ++i) {
    const ConvexPolygon a = random_polygon(random);
    const ConvexPolygon b = random_polygon(random, random_point(random));
    const ConvexPolygon shared = intersection(a, b);
    const Point point_m = random_point(random, 2.0);
    if (contains(a, point_m, -1e-9) && contains(b, point_m, -1e-9)) {
      EXPECT_TRUE(contains(shared, point_m, 1e-9)) << i;
    }
    EXPECT_NEAR(area_m2(shared), area_m2(intersection(b, a)), 1e-12) << i;
    EXPECT_NEAR(area_m2(intersection(a, a)), area_m2(a), 1e-12) << i;
    if (shared.empty()) continue;
    ++num_shared;
    for (const Point& corner_m : shared.vertices_m) {
      EXPECT_TRUE(contains(a, corner_m, 1e-9) && contains(b, corner_m, 1e-9)) << i;
    }
    const Point centre_m = centroid_m(shared);
    EXPECT_TRUE(contains(a, centre_m, 1e-12) && contains(b, centre_m, 1e-12)) << i;
  }
  EXPECT_GT(num_shared, 500U);
}

TEST(Polygon, IntersectionOfATriangleWithASquare) {
  const ConvexPolygon square{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}};
  const ConvexPolygon triangle{{{1.0, 1.0}, {4.0, 1.0}, {1.0, 4.0}}};
  EXPECT_NEAR(area_m2(intersection(square, triangle)), 1.0, 1e-12);
  EXPECT_NEAR(centroid_m(intersection(square, triangle)).x(), 1.5, 1e-12);
  EXPECT_NEAR(centroid_m(intersection(square, triangle)).y(), 1.5, 1e-12);
  const ConvexPolygon beside{{{2.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}, {2.0, 2.0}}};
  EXPECT_TRUE(intersection(square, beside).empty());
  EXPECT_TRUE(intersection(square, {}).empty());
  EXPECT_TRUE(intersection({}, square).empty());
  EXPECT_EQ(area_m2({}), 0.0);
}

}  // namespace
}  // namespace hlc
