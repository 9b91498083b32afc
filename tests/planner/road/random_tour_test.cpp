#include "planner/road/random_tour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "planner/common/random_index.hpp"
#include "planner/road/lab_network_map.hpp"
#include "planner/road/lap.hpp"
#include "planner/road/placement.hpp"
#include "planner/road/route.hpp"
#include "planner/road/town_map.hpp"
#include "tests/support/every.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::road::random_tour_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::uint8_t kVehicle = 1;

/// Lanelets with these successors; their bounds do not matter here.
LaneletMap map_of(const std::map<LaneletId, std::vector<LaneletId>>& successors) {
  LaneletMap map;
  for (const auto& [id, next] : successors) {
    map.lanelets[id].id = id;
    map.lanelets[id].successors = next;
  }
  return map;
}

/// Which lanelets can be reached from which (Warshall's algorithm).
class Reached {
 public:
  explicit Reached(const LaneletMap& map) {
    for (const auto& [id, lanelet] : map.lanelets) {
      reached_[id] = {lanelet.successors.begin(), lanelet.successors.end()};
    }
    for (const auto& [via, lanelet] : map.lanelets) {
      const std::set<LaneletId> onwards = reached_.at(via);
      for (auto& [id, ids] : reached_) {
        if (ids.contains(via)) ids.insert(onwards.begin(), onwards.end());
      }
    }
  }

  /// Those that can be reached from `start` and from which `start` can be reached.
  [[nodiscard]] std::set<LaneletId> on_closed_ways(LaneletId start) const {
    std::set<LaneletId> found;
    for (const LaneletId id : reached_.at(start)) {
      if (reached_.at(id).contains(start)) found.insert(id);
    }
    return found;
  }

 private:
  std::map<LaneletId, std::set<LaneletId>> reached_;
};

void expect_closed_tour(const LaneletMap& map, LaneletId start, std::uint64_t seed,
                        const std::set<LaneletId>& all) {
  const std::vector<LaneletId> tour = random_tour(map, start, seed, kVehicle);
  EXPECT_EQ(tour.at(1), start);
  for (std::size_t i = 0; i < tour.size(); ++i) {
    EXPECT_THAT(map.lanelets.at(tour[i]).successors,
                testing::Contains(tour[(i + 1) % tour.size()]));
  }
  EXPECT_EQ(std::set<LaneletId>(tour.begin(), tour.end()), all);
}

TEST(RandomTour, OfTheLabsNetworkClosesAndPassesThroughAllThatCanBeReached) {
  const LaneletMap map = lab_network_map();
  const Reached reached(map);
  for (const auto& [start, lanelet] : map.lanelets) {
    SCOPED_TRACE(start);
    expect_closed_tour(map, start, 1, reached.on_closed_ways(start));
  }
  for (std::uint64_t seed = 2; seed < 2 + test::num_seeds(20); ++seed) {
    SCOPED_TRACE(seed);
    expect_closed_tour(map, 22, seed, reached.on_closed_ways(22));
  }
  EXPECT_EQ(reached.on_closed_ways(22).size(), 88U);
  EXPECT_EQ(reached.on_closed_ways(4).size(), 16U);  // nothing leads off the outer ring
}

TEST(RandomTour, OfRandomGraphsClosesAndPassesThroughAllThatCanBeReached) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::map<LaneletId, std::vector<LaneletId>> successors;
    for (LaneletId id = 1; id <= 30; ++id) {
      std::set<LaneletId> next;
      const std::size_t num = random_index(random, 3);
      while (next.size() < num) next.insert(static_cast<LaneletId>(random_index(random, 30)) + 1);
      successors[id] = {next.begin(), next.end()};
    }
    const LaneletMap map = map_of(successors);
    const Reached reached(map);
    for (LaneletId start = 1; start <= 30; ++start) {
      const std::set<LaneletId> all = reached.on_closed_ways(start);
      if (all.empty()) {
        EXPECT_THROW(static_cast<void>(random_tour(map, start, seed, kVehicle)),
                     std::runtime_error);
      } else {
        expect_closed_tour(map, start, seed, all);
      }
    }
  }
}

TEST(RandomTour, OfATownClosesAndReturnsAfterTwoHundredLanelets) {
  const LaneletMap map = town_map({.columns = 3, .rows = 3});
  ASSERT_GT(map.lanelets.size(), 300U);
  for (std::uint64_t seed = 1; seed <= test::num_seeds(20); ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<LaneletId> tour = random_tour(map, 1, seed, kVehicle);
    expect_closed_tour(map, 1, seed, {tour.begin(), tour.end()});
    EXPECT_GE(tour.size(), 200U);
    EXPECT_LE(tour.size(), 230U) << "at most eight places to pass on the way back";
  }
}

TEST(RandomTour, IsTheSameOnEveryMachineAndAnotherOneForEverySeedAndVehicle) {
  const LaneletMap map = lab_network_map();
  const std::vector<LaneletId> tour = random_tour(map, 22, 1, kVehicle);
  EXPECT_THAT(std::vector<LaneletId>(tour.begin(), tour.begin() + 12),
              testing::ElementsAre(16, 22, 5, 7, 59, 57, 55, 67, 65, 77, 63, 61));
  EXPECT_EQ(tour, random_tour(map, 22, 1, kVehicle));
  EXPECT_NE(tour, random_tour(map, 22, 2, kVehicle));
  EXPECT_NE(tour, random_tour(map, 22, std::uint64_t{1} << 32U, kVehicle));
  EXPECT_NE(tour, random_tour(map, 22, 1, kVehicle + 1));
}

TEST(RandomTour, DeadEndsAreAvoidedOrRefusedByTheirNumbers) {
  const LaneletMap map = map_of({{1, {2}}, {2, {1, 3}}, {3, {}}, {4, {1}}, {5, {5}}});
  EXPECT_THAT(random_tour(map, 1, 1, kVehicle), testing::Not(testing::Contains(3)));
  expect_closed_tour(map, 5, 1, {5});
  const auto tour_from = [&](LaneletId start) {
    return [&map, start] { static_cast<void>(random_tour(map, start, 1, kVehicle)); };
  };
  EXPECT_THAT(tour_from(3), ThrowsMessage<std::runtime_error>(HasSubstr("lanelet 3")));
  EXPECT_THAT(tour_from(4), ThrowsMessage<std::runtime_error>(HasSubstr("lanelet 4")));
  EXPECT_THAT(tour_from(6), ThrowsMessage<std::runtime_error>(HasSubstr("lanelet 6 is not in")));
}

/// A car that drives the tour, from its start on.
class OnARandomTour : public testing::Test {
 protected:
  [[nodiscard]] Pose pose_at(double s_m) const {
    const Point position = route_.path.at(s_m);
    return {position.x(), position.y(), route_.path.heading_rad_at(s_m)};
  }

  const LaneletMap map_ = lab_network_map();
  const Route route_ = build_route(map_, random_tour(map_, 5, 3, kVehicle), true);
  const DrivableRoute drivable_{.name = "tour", .path = route_.path, .corridor = route_.corridor};
  const Footprint footprint_{.length_m = 0.22, .width_m = 0.107};
};

TEST_F(OnARandomTour, ACarNearItsStartIsFoundThereAndNotWhereTheTourComesByAgain) {
  const double start_s_m = route_.lanelet_s_m[1];
  for (const double ahead_m : {-0.02, -0.001, 0.0, 0.001, 0.02}) {
    for (const double left_m : {-0.005, 0.0, 0.005}) {
      const Pose on_path = pose_at(start_s_m + ahead_m);
      const Pose pose{on_path.x_m - left_m * std::sin(on_path.heading_rad),
                      on_path.y_m + left_m * std::cos(on_path.heading_rad), on_path.heading_rad};
      EXPECT_NEAR(placement_on(drivable_, pose, footprint_).s_m, start_s_m + ahead_m, 0.02);
      const std::vector<Point> positions{pose.position_m()};
      EXPECT_NEAR(progress_along(route_.path, positions).s_m.front(), start_s_m + ahead_m, 0.02);
    }
  }
}

TEST_F(OnARandomTour, ACarFurtherOnIsFoundAtTheNextOfItsPlaces) {
  const double middle_s_m = route_.path.length_m() / 2.0;
  for (const double s_m : test::every(0.37, middle_s_m, middle_s_m + 20.0)) {
    EXPECT_NEAR(placement_on(drivable_, pose_at(s_m), footprint_, s_m - 0.3).s_m, s_m, 1e-6);
  }
}

TEST_F(OnARandomTour, ProgressGoesRoundTheWholeTour) {
  const double start_s_m = route_.lanelet_s_m[1];
  std::vector<Point> positions_m;
  for (const double s_m : test::every(0.16, 0.0, route_.path.length_m() + 5.0)) {
    positions_m.push_back(route_.path.at(start_s_m + s_m));
  }
  const Progress progress = progress_along(route_.path, positions_m);
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    EXPECT_NEAR(progress.s_m[i], start_s_m + 0.16 * static_cast<double>(i), 0.01);
  }
}

}  // namespace
}  // namespace hlc::road::random_tour_test
