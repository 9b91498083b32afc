#include "planner/road/town_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <set>

#include "planner/common/text_file.hpp"
#include "planner/geometry/pose.hpp"
#include "tests/support/folders.hpp"

namespace hlc::road {

void PrintTo(const Blocks& blocks, std::ostream* out) {
  *out << blocks.columns << "x" << blocks.rows;
}

namespace {

class TownMap : public ::testing::TestWithParam<Blocks> {
 protected:
  const LaneletMap map_ = town_map(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Sizes, TownMap,
                         ::testing::Values(Blocks{1, 1}, Blocks{1, 3}, Blocks{4, 2}, Blocks{5, 4}),
                         ::testing::PrintToStringParamName());

/// All lanelets that are reached over these edges.
std::set<LaneletId> reached(const LaneletMap& map, std::vector<LaneletId> Lanelet::*next) {
  std::vector<LaneletId> open{map.lanelets.begin()->first};
  std::set<LaneletId> found;
  while (!open.empty()) {
    const LaneletId id = open.back();
    open.pop_back();
    if (!found.insert(id).second) continue;
    const std::vector<LaneletId>& more = map.lanelets.at(id).*next;
    open.insert(open.end(), more.begin(), more.end());
  }
  return found;
}

/// Left positive, by three neighbouring points.
double curvature_per_m(const Point& a, const Point& b, const Point& c) {
  const Point first = b - a;
  const Point second = c - b;
  const double turned_rad =
      std::atan2(first.x() * second.y() - first.y() * second.x(), first.dot(second));
  return turned_rad / (0.5 * (first.norm() + second.norm()));
}

TEST_P(TownMap, EveryLaneCanBeReachedFromEveryOtherOne) {
  EXPECT_EQ(reached(map_, &Lanelet::successors).size(), map_.lanelets.size());
  EXPECT_EQ(reached(map_, &Lanelet::predecessors).size(), map_.lanelets.size());
}

TEST_P(TownMap, HasAllWaysOfItsCrossingsJunctionsAndBends) {
  const auto [columns, rows] = GetParam();
  const int junctions = 2 * (columns + rows);
  const int ways = 12 * columns * rows + 6 * junctions + 2 * 4;
  const int roads = (columns + 1) * (rows + 2) + (columns + 2) * (rows + 1);
  EXPECT_EQ(map_.lanelets.size(), ways + 2 * 2 * roads);
  std::map<std::size_t, int> by_successors;
  for (const auto& [id, lanelet] : map_.lanelets) ++by_successors[lanelet.successors.size()];
  EXPECT_EQ(by_successors[3], 4 * columns * rows) << "roads that lead to a crossing";
  EXPECT_EQ(by_successors[2], 3 * junctions) << "roads that lead to a junction";
}

TEST_P(TownMap, LanesAreFifteenCentimetresWideAndJoinWithoutAnyGap) {
  for (const auto& [id, lanelet] : map_.lanelets) {
    for (std::size_t i = 0; i < lanelet.left_m.size(); ++i) {
      EXPECT_NEAR((lanelet.left_m[i] - lanelet.right_m[i]).norm(), 0.150, 1e-9) << id;
    }
    for (const LaneletId next : lanelet.successors) {
      const Lanelet& other = map_.lanelets.at(next);
      EXPECT_LT((lanelet.left_m.back() - other.left_m.front()).norm(), 1e-9) << id;
      EXPECT_LT((lanelet.right_m.back() - other.right_m.front()).norm(), 1e-9) << id;
    }
  }
}

TEST_P(TownMap, TurnsAreAsWideAsPromised) {
  double most_per_m = 0.0;
  double least_per_m = 0.0;
  for (const auto& [id, lanelet] : map_.lanelets) {
    const std::vector<Point> line = centre_line_m(lanelet);
    for (std::size_t i = 2; i < line.size(); ++i) {
      const double here_per_m = curvature_per_m(line[i - 2], line[i - 1], line[i]);
      most_per_m = std::max(most_per_m, here_per_m);
      least_per_m = std::min(least_per_m, here_per_m);
    }
  }
  EXPECT_NEAR(most_per_m, 1.55, 0.05);
  EXPECT_NEAR(least_per_m, -2.05, 0.05);
}

TEST(Town, ShippedFilesAreWhatTheGeneratorMakes) {
  struct Shipped {
    std::string file;
    Blocks blocks;
    double scale{};
  };
  for (const Shipped& one : {Shipped{"town.xml", {.columns = 5, .rows = 4}, 1.0},
                             Shipped{"town_full_size.xml", {.columns = 2, .rows = 2}, 18.0},
                             Shipped{"town_f1tenth.xml", {.columns = 2, .rows = 2}, 3.0}}) {
    const std::string shipped =
        read_file(std::filesystem::path(test::source_folder()) / "launch_scripts/maps" / one.file);
    EXPECT_LT(shipped.size(), 900'000U);
    EXPECT_TRUE(shipped == to_commonroad_xml(scaled(town_map(one.blocks), one.scale)))
        << one.file << " is out of date: its command is in launch_scripts/maps/README.md";
  }
}

TEST(Town, ScaledHasAllLengthsInTheSameProportion) {
  const LaneletMap town = town_map({.columns = 2, .rows = 1});
  const LaneletMap large = scaled(town, 18.0);
  EXPECT_EQ(large.benchmark_id, town.benchmark_id);
  EXPECT_NEAR(narrowest_lane_m(large), 18.0 * narrowest_lane_m(town), 1e-9);
  for (const auto& [id, lanelet] : town.lanelets) {
    EXPECT_EQ(large.lanelets.at(id).successors, lanelet.successors);
    EXPECT_EQ(large.lanelets.at(id).right_m.back(), Point(18.0 * lanelet.right_m.back()));
  }
}

TEST(Town, IsReadAsItWasWritten) {
  const std::string xml = to_commonroad_xml(town_map({.columns = 2, .rows = 1}));
  EXPECT_EQ(to_commonroad_xml(parse_lanelet_map(xml, "town")), xml);
}

}  // namespace
}  // namespace hlc::road
