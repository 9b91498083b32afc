#include "planner/road/lab_network_map.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "planner/common/text_file.hpp"
#include "planner/road/reference_path.hpp"
#include "tests/support/folders.hpp"

namespace hlc::road {
namespace {

const std::filesystem::path kSourceFolder = test::source_folder();

TEST(LabNetworkMap, ShippedFileIsWhatTheGeneratorMakes) {
  const std::string shipped = read_file(kSourceFolder / "launch_scripts/maps/lab_network.xml");
  EXPECT_LT(shipped.size(), 300'000U);
  EXPECT_TRUE(shipped == to_commonroad_xml(lab_network_map()))
      << "launch_scripts/maps/lab_network.xml is out of date: generate_map --shape lab_network "
         "--out makes it";
}

TEST(LabNetworkMap, LanesAreFifteenCentimetresWideAndJoinWithoutAnyGap) {
  const LaneletMap map = lab_network_map();
  for (const auto& [id, lanelet] : map.lanelets) {
    for (std::size_t i = 0; i < lanelet.left_m.size(); ++i) {
      EXPECT_NEAR((lanelet.left_m[i] - lanelet.right_m[i]).norm(), 0.150, 1e-9) << id;
    }
    EXPECT_FALSE(lanelet.successors.empty()) << id;
    for (const LaneletId next : lanelet.successors) {
      EXPECT_LT((lanelet.left_m.back() - map.lanelets.at(next).left_m.front()).norm(), 1e-9)
          << id << " -> " << next;
      EXPECT_LT((lanelet.right_m.back() - map.lanelets.at(next).right_m.front()).norm(), 1e-9)
          << id << " -> " << next;
    }
  }
}

TEST(LabNetworkMap, IsPointSymmetric) {
  const LaneletMap map = lab_network_map();
  for (LaneletId id = 1; id <= 26; ++id) {
    const std::vector<Point> line = centre_line_m(map.lanelets.at(id));
    const std::vector<Point> opposite = centre_line_m(map.lanelets.at(id + 78));
    ASSERT_EQ(line.size(), opposite.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
      EXPECT_LT((line[i] + opposite[i] - Point(4.5, 4.0)).norm(), 1e-9) << id;
    }
  }
}

/// The lab's own map, where the tests have it.
class LabNetworkMapBesideTheLabs : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto file = kSourceFolder / "../shared/data/LabMapCommonRoad.xml";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the lab's map is not here: " << file;
    lab_ = read_lanelet_map(file);
    ASSERT_EQ(lab_.lanelets.size(), ours_.lanelets.size());
  }

  LaneletMap lab_;
  const LaneletMap ours_ = lab_network_map();
};

TEST_F(LabNetworkMapBesideTheLabs, EveryLaneletFollowsTheLabsWithinTwoMillimetres) {
  for (const auto& [id, theirs] : lab_.lanelets) {
    const std::vector<Point> ours_m = centre_line_m(ours_.lanelets.at(id));
    const std::vector<Point> theirs_m = centre_line_m(theirs);
    const ReferencePath path(ours_m, false);
    for (const Point& point : theirs_m) EXPECT_LT(path.project(point).distance_m, 0.002) << id;
    EXPECT_LT((ours_m.front() - theirs_m.front()).norm(), 0.002) << id;
    EXPECT_LT((ours_m.back() - theirs_m.back()).norm(), 0.002) << id;
  }
}

TEST_F(LabNetworkMapBesideTheLabs, EveryLaneletHasTheSameRelations) {
  for (const auto& [id, theirs] : lab_.lanelets) {
    const Lanelet& ours = ours_.lanelets.at(id);
    EXPECT_EQ(ours.predecessors, theirs.predecessors) << id;
    EXPECT_EQ(ours.successors, theirs.successors) << id;
    EXPECT_EQ(ours.adjacent_left, theirs.adjacent_left) << id;
    EXPECT_EQ(ours.adjacent_right, theirs.adjacent_right) << id;
  }
}

}  // namespace
}  // namespace hlc::road
