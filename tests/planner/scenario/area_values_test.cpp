#include "planner/scenario/area_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "planner/geometry/footprint.hpp"

namespace hlc::scenario::area_values_test {
namespace {

using testing::HasSubstr;

ConvexPolygon area(const std::string& yaml) { return read_area(Node::parse_yaml(yaml, "areas")); }

std::string error_of(const std::string& yaml) {
  try {
    static_cast<void>(area(yaml));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(AreaValues, ARectangleLiesAroundItsMiddleAlongItsHeading) {
  EXPECT_EQ(area("rectangle: {x_m: 1, y_m: 2, heading_rad: 0.5, length_m: 0.4, width_m: 0.2}"),
            footprint_area({0.4, 0.2}, {1.0, 2.0, 0.5}));
  EXPECT_EQ(area("rectangle: {x_m: 1, y_m: 2, length_m: 0.4, width_m: 0.2}"),
            footprint_area({0.4, 0.2}, {1.0, 2.0, 0.0}));
}

TEST(AreaValues, ACircleIsEnclosedByAPolygonThatIsTwoPercentLargerAtMost) {
  const ConvexPolygon polygon = area("circle: {x_m: -3, y_m: 2, radius_m: 0.5}");
  ASSERT_EQ(polygon.vertices_m.size(), kCircleCorners);
  EXPECT_EQ(convex_hull({polygon.vertices_m.begin(), polygon.vertices_m.end()}).vertices_m.size(),
            kCircleCorners);
  for (int i = 0; i < 3600; ++i) {
    const double angle_rad = std::numbers::pi * i / 1800.0;
    const Point rim_m = Point(-3.0, 2.0) + 0.5 * Point(std::cos(angle_rad), std::sin(angle_rad));
    EXPECT_TRUE(contains(polygon, rim_m, 1e-12)) << angle_rad;
  }
  for (const Point& corner : polygon.vertices_m) {
    EXPECT_LE((corner - Point(-3.0, 2.0)).norm(), 1.02 * 0.5);
  }
}

TEST(AreaValues, APolygonMayGoEitherWayRoundFromAnyCorner) {
  const ConvexPolygon expected = area("polygon: [[0, 0], [2, 0], [2, 1], [0, 1]]");
  EXPECT_EQ(area("polygon: [[0, 1], [2, 1], [2, 0], [0, 0]]"), expected);
  EXPECT_EQ(area("polygon: [[2, 1], [0, 1], [0, 0], [2, 0]]"), expected);
}

TEST(AreaValues, APolygonThatIsNotConvexIsRefused) {
  for (const char* corners :
       {"[[0, 0], [2, 0], [1, 0.2], [0, 1]]", "[[0, 0], [1, 1], [1, 0], [0, 1]]",
        "[[0, 0], [1, 0], [2, 0], [1, 1]]", "[[0, 0], [0, 0], [1, 0], [1, 1]]",
        "[[0, 0], [1, 1], [2, 2]]"}) {
    EXPECT_THAT(error_of("polygon: " + std::string(corners)),
                AllOf(HasSubstr("areas:1: polygon = "), HasSubstr("must be convex")))
        << corners;
  }
}

TEST(AreaValues, ExactlyOneShapeWithinBoundsIsAccepted) {
  EXPECT_THAT(error_of("name: x"), HasSubstr("the only one of rectangle, circle and polygon"));
  EXPECT_THAT(error_of("circle: {x_m: 0, y_m: 0, radius_m: 1}\n"
                       "polygon: [[0, 0], [1, 0], [0, 1]]"),
              HasSubstr("the only one of rectangle, circle and polygon"));
  EXPECT_THAT(error_of("circle: {x_m: 0, y_m: 0, radius_m: 0}"),
              HasSubstr("circle.radius_m = 0, must be a number >= 0.001 and <= 1000"));
  EXPECT_THAT(error_of("circle: {x_m: 1e9, y_m: 0, radius_m: 1}"), HasSubstr("circle.x_m = 1e9"));
  EXPECT_THAT(error_of("rectangle: {x_m: 0, y_m: 0, length_m: -1, width_m: 1}"),
              HasSubstr("rectangle.length_m = -1"));
  EXPECT_THAT(error_of("rectangle: {x_m: 0, y_m: 0, length_m: 1, width_m: 1, heading_deg: 3}"),
              HasSubstr("heading_deg"));
  EXPECT_THAT(error_of("circle: {x_m: 0, y_m: 0, radius: 1}"), HasSubstr("circle.radius = 1"));
  EXPECT_THAT(error_of("polygon: [[0, 0], [1, 0]]"), HasSubstr("a list of 3 ... 32 corners, got"));
  EXPECT_THAT(error_of("polygon: [[0, 0], [1, 0], [0, 1, 2]]"), HasSubstr("a corner [x, y] in m"));
}

}  // namespace
}  // namespace hlc::scenario::area_values_test
