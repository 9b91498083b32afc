#include "planner/road/map_obstacles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "planner/geometry/footprint.hpp"

namespace hlc::road::map_obstacles_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string file_with(const std::string& content, const std::string& version = "2020a") {
  return "<commonRoad benchmarkID=\"ZAM_A-1\" commonRoadVersion=\"" + version + "\">\n" + content +
         "\n</commonRoad>\n";
}

std::string state_at(const std::string& x, const std::string& y, const std::string& heading) {
  return "<initialState><position><point><x>" + x + "</x><y>" + y +
         "</y></point></position><orientation><exact>" + heading +
         "</exact></orientation><time><exact>0</exact></time></initialState>";
}

std::string parked(const std::string& shapes, const std::string& state) {
  return "<staticObstacle id=\"42\"><type>parkedVehicle</type><shape>" + shapes + "</shape>" +
         state + "</staticObstacle>";
}

const std::string kBox = "<rectangle><length>2</length><width>1</width></rectangle>";

std::vector<MapObstacle> read(const std::string& xml) {
  return parse_map_obstacles(xml, "map.xml");
}

std::string refusal(const std::string& xml) {
  try {
    static_cast<void>(read(xml));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// The one area of the one obstacle.
ConvexPolygon area_of(const std::string& xml) { return read(xml).at(0).areas_m.at(0); }

void expect_same(const ConvexPolygon& area_m, const ConvexPolygon& expected_m) {
  EXPECT_TRUE(contains(area_m, expected_m, 1e-9));
  EXPECT_TRUE(contains(expected_m, area_m, 1e-9));
}

TEST(MapObstacles, AreNoneOfAMapWithoutThem) {
  EXPECT_TRUE(read(file_with("<lanelet id=\"1\"/><planningProblem id=\"9\"/>")).empty());
}

TEST(MapObstacles, StandAtTheirInitialState) {
  const auto obstacles = read(file_with(parked(kBox, state_at("3", "4", "1.5"))));
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_EQ(obstacles[0].id, 42);
  EXPECT_EQ(obstacles[0].type, "parkedVehicle");
  ASSERT_EQ(obstacles[0].areas_m.size(), 1U);
  expect_same(obstacles[0].areas_m[0], footprint_area({2.0, 1.0}, {3.0, 4.0, 1.5}));
}

TEST(MapObstacles, HaveShapesInTheirOwnFrame) {
  const std::string beside =
      "<rectangle><length>2</length><width>1</width><orientation>0.5</orientation>"
      "<center><x>1</x><y>0</y></center></rectangle>";
  expect_same(area_of(file_with(parked(beside, state_at("0", "0", "1.5707963267948966")))),
              footprint_area({2.0, 1.0}, {0.0, 1.0, 0.5 + std::numbers::pi / 2.0}));
  const std::string polygon =
      "<polygon><point><x>0</x><y>0</y></point><point><x>1</x><y>0</y></point>"
      "<point><x>0</x><y>1</y></point></polygon>";
  expect_same(area_of(file_with(parked(polygon, state_at("5", "0", "0")))),
              convex_hull(std::vector{Point(5.0, 0.0), Point(6.0, 0.0), Point(5.0, 1.0)}));
}

TEST(MapObstacles, HavePolygonsAroundTheirCircles) {
  const ConvexPolygon area_m = area_of(
      file_with(parked("<circle><radius>0.5</radius></circle>", state_at("1", "2", "0.3"))));
  for (int i = 0; i < 1000; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 1000.0;
    EXPECT_TRUE(contains(
        area_m, Point(1.0 + 0.5 * std::cos(angle_rad), 2.0 + 0.5 * std::sin(angle_rad)), 1e-12));
  }
  for (const Point& corner : area_m.vertices_m) {
    EXPECT_LT((corner - Point(1.0, 2.0)).norm(), 0.51);
  }
}

TEST(MapObstacles, AreReadFromTheOlderVersion) {
  const std::string older =
      "<obstacle id=\"42\"><role>static</role><type>parkedVehicle</type><shape>" + kBox +
      "</shape>" + state_at("3", "4", "1.5") + "</obstacle>";
  EXPECT_EQ(read(file_with(older, "2018b")),
            read(file_with(parked(kBox, state_at("3", "4", "1.5")))));
}

TEST(MapObstacles, WhatIsNotRegardedIsRefusedByItsName) {
  for (const std::string name : {"dynamicObstacle", "environmentObstacle", "phantomObstacle",
                                 "trafficSign", "trafficLight"}) {
    EXPECT_THAT(refusal(file_with("<" + name + " id=\"7\"/>")),
                HasSubstr("map.xml:2: <" + name + "> \"7\": is not regarded, must be absent"));
  }
  EXPECT_THAT(refusal(file_with("<obstacle id=\"8\"><role>dynamic</role></obstacle>", "2018b")),
              HasSubstr("<obstacle> \"8\": is not regarded"));
}

TEST(MapObstacles, ThatAreIncompleteAreRefusedWithTheirLine) {
  const std::string state = state_at("0", "0", "0");
  EXPECT_THAT(refusal(file_with(parked("", state))), HasSubstr("map.xml:2: <shape> is empty"));
  EXPECT_THAT(refusal(file_with(parked("<cube/>", state))), HasSubstr("<shape> has a <cube>"));
  EXPECT_THAT(refusal(file_with(parked(kBox, ""))), HasSubstr("needs a <initialState>"));
  EXPECT_THAT(refusal(file_with(parked(kBox, state_at("0", "far", "0")))),
              HasSubstr("<y> is \"far\", must be a finite number [m]"));
  EXPECT_THAT(refusal(file_with(parked("<circle><radius>0</radius></circle>", state))),
              HasSubstr("<radius> is 0, must be > 0 and <= 1000 [m]"));
  EXPECT_THAT(refusal(file_with(parked("<polygon/>", state))), HasSubstr("<polygon> has no area"));
  EXPECT_THAT(refusal("<osm/>"), HasSubstr("root element must be <commonRoad>"));
}

}  // namespace
}  // namespace hlc::road::map_obstacles_test
