#include "planner/road/lab_like_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "planner/road/route.hpp"
#include "tests/support/folders.hpp"

namespace hlc::road {
namespace {

const std::filesystem::path kSource = test::source_folder();

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

ReferencePath path_of(const Lanelet& lanelet) { return {centre_line_m(lanelet), false}; }

TEST(LabLikeMap, ShippedFileIsWhatTheGeneratorMakes) {
  const std::string shipped = content_of(kSource / "launch_scripts/maps/lab_like.xml");
  EXPECT_LT(shipped.size(), 300'000U);
  EXPECT_TRUE(shipped == to_commonroad_xml(lab_like_map().map))
      << "launch_scripts/maps/lab_like.xml is out of date: generate_map --out makes it";
}

TEST(LabLikeMap, DocumentNamesTheRoutes) {
  const std::string document = content_of(kSource / "launch_scripts/maps/README.md");
  for (const NamedRoute& route : lab_like_map().routes) {
    std::string ids;
    for (const LaneletId id : route.lanelets) {
      ids += (ids.empty() ? "" : ", ") + std::to_string(id);
    }
    EXPECT_THAT(document, ::testing::HasSubstr("| " + route.name + " | " + ids + " |"));
  }
}

TEST(LabLikeMap, ShippedFileJoinsLaneletsWithoutAnyGap) {
  const LaneletMap map = read_lanelet_map(kSource / "launch_scripts/maps/lab_like.xml");
  for (const auto& [id, lanelet] : map.lanelets) {
    for (const LaneletId next_id : lanelet.successors) {
      const Lanelet& next = map.lanelets.at(next_id);
      EXPECT_EQ(lanelet.left_m.back(), next.left_m.front()) << id << " -> " << next_id;
      EXPECT_EQ(lanelet.right_m.back(), next.right_m.front()) << id << " -> " << next_id;
      EXPECT_THAT(next.predecessors, ::testing::Contains(id));
    }
    if (lanelet.adjacent_left) {
      const Lanelet& left = map.lanelets.at(lanelet.adjacent_left->id);
      EXPECT_EQ(lanelet.left_m, left.right_m) << id;
      EXPECT_EQ(left.adjacent_right, (Lanelet::Adjacent{id, true}));
    }
  }
}

TEST(LabLikeMap, LanesAreFifteenCentimetresWideWithPointsFiveApart) {
  for (const auto& [id, lanelet] : lab_like_map().map.lanelets) {
    const std::vector<Point> centre = centre_line_m(lanelet);
    for (std::size_t i = 0; i < centre.size(); ++i) {
      EXPECT_NEAR((lanelet.left_m[i] - lanelet.right_m[i]).norm(), 0.150, 1e-9) << id;
      if (i > 0) {
        EXPECT_GT((centre[i] - centre[i - 1]).norm(), 0.02) << id;
        EXPECT_LT((centre[i] - centre[i - 1]).norm(), 0.07) << id;
      }
    }
  }
}

TEST(LabLikeMap, EveryLaneletOfARouteIsASuccessorOfTheOneBefore) {
  const RoadNetwork network = lab_like_map();
  for (const NamedRoute& route : network.routes) {
    for (std::size_t i = 0; i < route.lanelets.size(); ++i) {
      const LaneletId next = route.lanelets[(i + 1) % route.lanelets.size()];
      EXPECT_THAT(network.map.lanelets.at(route.lanelets[i]).successors, ::testing::Contains(next))
          << route.name;
    }
  }
}

TEST(LabLikeMap, RedIsPointSymmetric) {
  const RoadNetwork network = lab_like_map();
  const auto& red = network.routes.at(0).lanelets;
  for (std::size_t i = 0; i < red.size(); ++i) {
    const Lanelet& lanelet = network.map.lanelets.at(red[i]);
    const Lanelet& opposite = network.map.lanelets.at(red[(i + red.size() / 2) % red.size()]);
    ASSERT_EQ(lanelet.left_m.size(), opposite.left_m.size());
    for (std::size_t j = 0; j < lanelet.left_m.size(); ++j) {
      EXPECT_NEAR((lanelet.left_m[j] + opposite.left_m[j] - Point(4.5, 4.0)).norm(), 0.0, 1e-12);
    }
  }
}

TEST(LabLikeMap, RedHasItsNeighbourRightThenLeft) {
  const RoadNetwork network = lab_like_map();
  const Route red = build_route(network.map, network.routes.at(0).lanelets, true);
  for (std::size_t i = 0; i < red.lanelets.size(); ++i) {
    const Lanelet& lanelet = network.map.lanelets.at(red.lanelets[i]);
    const double middle_s_m = (red.lanelet_s_m[i] + red.lanelet_s_m[i + 1]) / 2.0;
    const bool right = middle_s_m < 4.628 || (middle_s_m > 6.113 && middle_s_m < 10.737);
    EXPECT_EQ(lanelet.adjacent_right.has_value(), right) << middle_s_m;
    EXPECT_EQ(lanelet.adjacent_left.has_value(), !right) << middle_s_m;
  }
}

TEST(LabLikeMap, SharedStretchesAreOneLanelet) {
  // Two lanelets with the same direction may run into each other where lanes merge, but not run in
  // each other for more than a car's length and a half.
  const LaneletMap map = lab_like_map().map;
  for (const auto& [id, lanelet] : map.lanelets) {
    for (const auto& [other_id, other] : map.lanelets) {
      if (id == other_id) {
        continue;
      }
      const ReferencePath path = path_of(lanelet);
      const ReferencePath other_path = path_of(other);
      double together_m = 0.0;
      for (double s_m = 0.0; s_m < path.length_m(); s_m += 0.02) {
        const auto projection = other_path.project(path.at(s_m));
        const double turn = path.heading_rad_at(s_m) - other_path.heading_rad_at(projection.s_m);
        together_m += projection.distance_m < 0.008 && std::cos(turn) > 0.99 ? 0.02 : 0.0;
      }
      EXPECT_LT(together_m, 0.33) << id << " and " << other_id;
    }
  }
}

TEST(LabLikeMap, CentreLinesFollowTheLabsWithinEightMillimetres) {
  const auto file = kSource / "../shared/data/LabMapCommonRoad.xml";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the lab's map is not here: " << file;
  }
  const LaneletMap lab = read_lanelet_map(file);
  const std::vector<std::vector<LaneletId>> lab_routes = {
      {41, 39, 20, 63, 61, 57, 55, 67, 65, 98, 37, 35, 31, 29},
      {64, 62, 75, 55, 53, 79, 81, 101, 88, 90, 95, 69},
      {57, 74, 68, 66, 71, 19, 14, 16, 22, 5, 7, 59}};
  const RoadNetwork network = lab_like_map();
  for (std::size_t r = 0; r < lab_routes.size(); ++r) {
    const Route ours = build_route(network.map, network.routes[r].lanelets, true);
    const Route theirs = build_route(lab, lab_routes[r], true);
    for (const Point& point : theirs.path.points_m()) {
      EXPECT_LT(ours.path.project(point).distance_m, 0.008) << network.routes[r].name;
    }
    // Both begin at the same place, so arc lengths mean the same within the difference of lengths.
    EXPECT_LT((ours.path.at(0.0) - theirs.path.at(0.0)).norm(), 0.005) << network.routes[r].name;
  }
}

}  // namespace
}  // namespace hlc::road
