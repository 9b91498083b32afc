#include "planner/right_of_way/conflict_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>

#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::right_of_way {
namespace {

/// Stretches of conflict cells.
std::size_t num_stretches(const ConflictMap& map, std::size_t route) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.num_cells(route); ++i) {
    const std::size_t before = (i + map.num_cells(route) - 1) % map.num_cells(route);
    count += map.is_conflict(route, i) && !map.is_conflict(route, before) ? 1U : 0U;
  }
  return count;
}

std::set<std::uint32_t> numbers_on(const ConflictMap& map, std::size_t route) {
  const std::vector<std::uint32_t> zones = conflict_zones(map);
  std::set<std::uint32_t> numbers;
  for (std::size_t i = 0; i < map.num_cells(route); ++i) numbers.insert(zones[map.cell(route, i)]);
  numbers.erase(0);
  return numbers;
}

TEST(ConflictZones, BothRoutesThroughACrossingPassTheSameOnes) {
  const std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, 1.0), circle({1.2, 0.0}, 1.0)};
  const ConflictMap map(routes, kCar);
  ASSERT_EQ(num_stretches(map, 0), 2U);
  EXPECT_EQ(numbers_on(map, 0), (std::set<std::uint32_t>{1, 2}));
  EXPECT_EQ(numbers_on(map, 1), (std::set<std::uint32_t>{1, 2}));
}

TEST(ConflictZones, TheOneBehindAPlaceBeginsInTheNextCell) {
  const std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, 1.0), circle({1.2, 0.0}, 1.0)};
  const ConflictMap map(routes, kCar);
  const std::vector<std::uint32_t> zones = conflict_zones(map);
  for (std::size_t i = 0; i < map.num_cells(0); ++i) {
    const double s_m = map.cell_m(0) * static_cast<double>(i);
    const std::size_t next = (i + 1) % map.num_cells(0);
    EXPECT_EQ(zone_behind(map, 0, s_m), zones[map.cell(0, next)]) << i;
  }
}

TEST(ConflictZones, ARouteThatMeetsNoOtherHasNone) {
  const std::vector<road::DrivableRoute> routes{circle({0.0, 0.0}, 1.0), circle({0.0, 0.0}, 2.0)};
  const ConflictMap map(routes, kCar);
  EXPECT_TRUE(numbers_on(map, 0).empty());
}

TEST(ConflictZones, ACrossingWithItselfIsOne) {
  const std::vector<road::DrivableRoute> routes{figure_eight()};
  EXPECT_EQ(numbers_on(ConflictMap(routes, kCar), 0), std::set<std::uint32_t>{1});
}

TEST(ConflictZones, OnTheLabsRoadHoldAllConflictCellsAndThoseThatOverlapTogether) {
  const ConflictMap& map = *lab_cars().conflicts;
  const std::vector<std::uint32_t> zones = conflict_zones(map);
  std::vector<bool> is_conflict(map.num_cells());
  for (std::size_t route = 0; route < map.num_routes(); ++route) {
    for (std::size_t i = 0; i < map.num_cells(route); ++i) {
      is_conflict[map.cell(route, i)] = map.is_conflict(route, i);
    }
  }
  for (std::size_t route = 0; route < map.num_routes(); ++route) {
    for (std::size_t i = 0; i < map.num_cells(route); ++i) {
      const std::uint32_t cell = map.cell(route, i);
      ASSERT_EQ(zones[cell] != 0, is_conflict[cell]);
      for (const std::uint32_t other : map.overlaps(route, i)) {
        const bool are_conflicts = is_conflict[cell] && is_conflict[other];
        ASSERT_TRUE(!are_conflicts || zones[cell] == zones[other]);
      }
    }
  }
  const std::uint32_t last = *std::ranges::max_element(zones);
  std::set<std::uint32_t> all(zones.begin(), zones.end());
  EXPECT_EQ(all.size(), last + 1U) << "numbers without a gap, and 0";
  EXPECT_EQ(last, 17U) << "16 where lanes part or merge on the outer loop, and the intersection";
}

}  // namespace
}  // namespace hlc::right_of_way
