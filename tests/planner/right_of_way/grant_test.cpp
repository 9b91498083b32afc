#include "planner/right_of_way/grant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <random>
#include <span>
#include <utility>

#include "planner/scenario/starts.hpp"
#include "tests/planner/right_of_way/held_cells.hpp"
#include "tests/planner/right_of_way/random_traffic.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::right_of_way {
namespace {

constexpr double kLookAhead_m = 1.6;

bool are_disjoint(const ConflictMap& map, const std::vector<Holder>& holders) {
  for (std::size_t i = 0; i < holders.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (hold_overlapping_cells(map, holders[i], holders[j])) return false;
    }
  }
  return true;
}

bool ends_in_conflict(const ConflictMap& map, const Holder& holder) {
  const std::size_t route = holder.claim.route;
  const double end_m = holder.claim.place_m + holder.claim.ahead_m;
  return map.is_conflict(route, on_route(map, route, cell_at(map, route, end_m)));
}

std::vector<Holder> granted(const ConflictMap& map, std::vector<Holder> holders,
                            std::span<const Blocked> blocked = {},
                            const GrantOrder& order = kLongestWait) {
  const std::vector<double> ahead_m = grant(map, holders, blocked, kLookAhead_m, order);
  for (std::size_t i = 0; i < holders.size(); ++i) holders[i].claim.ahead_m = ahead_m[i];
  return holders;
}

/// Up to 25 vehicles anywhere on the routes, no two with overlapping cells.
std::vector<Holder> random_holders(const ConflictMap& map, std::mt19937_64& random) {
  std::vector<Holder> holders;
  for (int i = 0; i < 25; ++i) {
    const auto route = static_cast<std::uint32_t>(random() % map.num_routes());
    const Holder holder{
        .vehicle = {static_cast<std::uint8_t>(i + 1)},
        .claim = {.route = route,
                  .place_m = std::uniform_real_distribution(0.0, map.length_m(route))(random),
                  .ahead_m = std::uniform_real_distribution(0.0, 0.8)(random),
                  .waiting_steps = static_cast<std::uint32_t>(random() % 4)}};
    if (std::ranges::none_of(holders, [&](const Holder& other) {
          return hold_overlapping_cells(map, holder, other);
        })) {
      holders.push_back(holder);
    }
  }
  std::ranges::shuffle(holders, random);
  return holders;
}

template <class Check>
void for_random_holders(const Check& check) {
  const ConflictMap& map = *lab_cars().conflicts;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(200); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const std::vector<Holder> before = random_holders(map, random);
    ASSERT_GE(before.size(), 5U);
    check(map, before, random);
  }
}

TEST(Grant, TakesNothingFromAnyoneAndNoTwoVehiclesGetOverlappingCells) {
  double gained_m = 0.0;
  for_random_holders([&](const ConflictMap& map, const std::vector<Holder>& before, auto&) {
    const std::vector<Holder> after = granted(map, before);
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_GE(after[i].claim.ahead_m, before[i].claim.ahead_m);
      gained_m += after[i].claim.ahead_m - before[i].claim.ahead_m;
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(hold_overlapping_cells(map, after[i], after[j])) << i << ' ' << j;
      }
    }
  });
  EXPECT_GT(gained_m, 100.0);
}

TEST(Grant, TakesNothingFromAnyoneInAnyOrder) {
  std::size_t different = 0;
  for_random_holders([&](const ConflictMap& map, const std::vector<Holder>& before, auto&) {
    const std::vector<Holder> usual = granted(map, before);
    for (const GrantOrder* order : grant_orders()) {
      SCOPED_TRACE(order->name);
      const std::vector<Holder> after = granted(map, before, {}, *order);
      EXPECT_TRUE(are_disjoint(map, after));
      for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_GE(after[i].claim.ahead_m, before[i].claim.ahead_m);
      }
      if (after != usual) ++different;
    }
  });
  EXPECT_GT(different, 0U);
}

TEST(Grant, AStretchOfConflictCellsIsTakenAsAWholeOrNotAtAll) {
  for_random_holders([](const ConflictMap& map, const std::vector<Holder>& before, auto&) {
    const std::vector<Holder> after = granted(map, before);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (after[i].claim.ahead_m == before[i].claim.ahead_m) continue;
      EXPECT_FALSE(ends_in_conflict(map, after[i])) << i;
    }
  });
}

TEST(Grant, NothingIsTakenBeyondTheLookAheadButTheRestOfAStretch) {
  std::size_t beyond = 0;
  for_random_holders([&](const ConflictMap& map, const std::vector<Holder>& before, auto&) {
    const std::vector<Holder> after = granted(map, before);
    for (const Holder& one : after) {
      const std::size_t route = one.claim.route;
      if (one.claim.ahead_m <= kLookAhead_m) continue;
      ++beyond;
      const double place_m = one.claim.place_m;
      const auto last_within =
          static_cast<std::int64_t>((place_m + kLookAhead_m) / map.cell_m(route));
      for (std::int64_t cell = last_within; cell < cell_at(map, route, place_m + one.claim.ahead_m);
           ++cell) {
        EXPECT_TRUE(map.is_conflict(route, on_route(map, route, cell)));
      }
    }
  });
  EXPECT_GT(beyond, 10U);
}

std::vector<Blocked> random_blocked(std::mt19937_64& random) {
  std::vector<Blocked> blocked;
  std::uniform_real_distribution<double> anywhere(0.0, 4.0);
  for (std::uint8_t i = 101; i <= 108; ++i) {
    const Pose pose{anywhere(random), anywhere(random), anywhere(random)};
    blocked.push_back({VehicleId{i}, footprint_area(kCar.footprint, pose)});
  }
  return blocked;
}

TEST(Grant, BlockedAreasAreNotEntered) {
  std::size_t shorter = 0;
  for_random_holders([&](const ConflictMap& map, const std::vector<Holder>& before, auto& random) {
    const std::vector<Blocked> blocked = random_blocked(random);
    const std::vector<Holder> after = granted(map, before, blocked);
    const std::vector<Holder> unblocked = granted(map, before);
    for (std::size_t i = 0; i < after.size(); ++i) {
      shorter += after[i].claim.ahead_m < unblocked[i].claim.ahead_m ? 1U : 0U;
      std::vector<std::size_t> taken =
          cells_of(map, after[i], before[i].claim.ahead_m, after[i].claim.ahead_m);
      taken.erase(taken.begin());  // held before
      for (const std::size_t cell : taken) {
        for (const Blocked& one : blocked) {
          EXPECT_FALSE(intersects(map.area_m(after[i].claim.route, cell), one.area_m));
        }
      }
    }
  });
  EXPECT_GT(shorter, 10U);
}

TEST(Grant, WhoBlocksTheNextCellsIsNamed) {
  std::size_t named = 0;
  for_random_holders([&](const ConflictMap& map, const std::vector<Holder>& before, auto& random) {
    const std::vector<Blocked> blocked = random_blocked(random);
    const std::vector<Holder> after = granted(map, before, blocked);
    const std::vector<Holder> unblocked = granted(map, before);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (after[i].claim.ahead_m >= unblocked[i].claim.ahead_m) continue;
      const std::vector<VehicleId> by = withheld_by(map, after, blocked, i);
      EXPECT_FALSE(by.empty());
      named += std::ranges::any_of(by, [](VehicleId one) { return one.value > 100; }) ? 1U : 0U;
    }
  });
  EXPECT_GT(named, 10U);
}

TEST(Grant, AnObstacleThatIsNoVehicleEndsAuthoritiesAndIsNobodyWhoWithholds) {
  const ConflictMap& map = *lab_cars().conflicts;
  const Holder alone{.vehicle = {1}, .claim = {}};
  const Blocked obstacle{std::nullopt, map.area_m(0, 10)};
  const std::vector<Holder> after = granted(map, {alone}, std::span(&obstacle, 1));
  EXPECT_LT(after.front().claim.ahead_m, granted(map, {alone}).front().claim.ahead_m);
  EXPECT_TRUE(withheld_by(map, after, std::span(&obstacle, 1), 0).empty());
}

TEST(Grant, TheOrderOfTheInputDoesNotMatter) {
  for_random_holders([](const ConflictMap& map, const std::vector<Holder>& before, auto& random) {
    std::vector<Holder> after = granted(map, before);
    std::vector<Holder> shuffled = before;
    std::ranges::shuffle(shuffled, random);
    shuffled = granted(map, std::move(shuffled));
    const auto by_vehicle = [](const Holder& one) { return one.vehicle; };
    std::ranges::sort(after, {}, by_vehicle);
    std::ranges::sort(shuffled, {}, by_vehicle);
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(after[i].claim.ahead_m, shuffled[i].claim.ahead_m) << i;
    }
  });
}

TEST(Grant, AllThatCanBeGrantedIsGrantedAtOnce) {
  for_random_holders([](const ConflictMap& map, const std::vector<Holder>& before, auto&) {
    const std::vector<Holder> after = granted(map, before);
    const std::vector<Holder> again = granted(map, after);
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(again[i].claim.ahead_m, after[i].claim.ahead_m) << i;
    }
  });
}

/// Two vehicles before the same crossing of two circles.
class GrantAtACrossing : public testing::Test {
 protected:
  [[nodiscard]] Holder before_crossing(std::uint8_t vehicle, std::uint32_t route, double by_m,
                                       std::uint32_t waiting_steps) const {
    return {.vehicle = {vehicle},
            .claim = {.route = route,
                      .place_m = routes_[route].path.project({0.6, 0.8}).s_m - by_m,
                      .waiting_steps = waiting_steps}};
  }
  /// Whether it may cross.
  [[nodiscard]] std::vector<bool> may_cross(const std::vector<Holder>& holders) const {
    std::vector<bool> result;
    for (const double ahead_m : grant(map_, holders, {}, kLookAhead_m)) {
      result.push_back(ahead_m > 0.6);
    }
    return result;
  }

  std::vector<road::DrivableRoute> routes_{circle({0.0, 0.0}, 1.0), circle({1.2, 0.0}, 1.0)};
  ConflictMap map_{routes_, kCar};
};

TEST_F(GrantAtACrossing, TheSmallerIdComesFirstIfNobodyHasWaitedLonger) {
  const Holder one = before_crossing(1, 0, 0.5, 3);
  const Holder two = before_crossing(2, 1, 0.5, 3);
  EXPECT_EQ(may_cross({one, two}), (std::vector{true, false}));
  EXPECT_EQ(may_cross({two, one}), (std::vector{false, true}));
}

TEST_F(GrantAtACrossing, WhoHasWaitedLongerComesFirst) {
  const Holder one = before_crossing(1, 0, 0.5, 3);
  const Holder two = before_crossing(2, 1, 0.5, 4);
  EXPECT_EQ(may_cross({one, two}), (std::vector{false, true}));
  EXPECT_EQ(may_cross({two, one}), (std::vector{true, false}));
}

TEST_F(GrantAtACrossing, WhatIsHeldIsNotGrantedToOneWhoHasWaitedLonger) {
  const Holder one = before_crossing(1, 0, 0.5, 100);
  Holder two = before_crossing(2, 1, 0.5, 0);
  two.claim.ahead_m = 1.0;
  EXPECT_EQ(may_cross({one, two}), (std::vector{false, true}));
}

TEST_F(GrantAtACrossing, WhoMayNotCrossStopsInFrontOfTheFirstConflictCell) {
  const Holder one = before_crossing(1, 0, 0.5, 0);
  const Holder two = before_crossing(2, 1, 0.5, 0);
  const std::vector<Holder> after = granted(map_, {one, two});
  const std::size_t route = two.claim.route;
  const std::int64_t end = cell_at(map_, route, two.claim.place_m + after[1].claim.ahead_m);
  EXPECT_FALSE(map_.is_conflict(route, on_route(map_, route, end)));
  EXPECT_TRUE(map_.is_conflict(route, on_route(map_, route, end + 1)));
}

TEST_F(GrantAtACrossing, BehindAVehicleAheadItEndsAtThatOnesPlace) {
  Holder ahead = before_crossing(1, 0, -1.0, 0);  // beyond the crossing
  ahead.claim.ahead_m = 1.0;
  const Holder behind = before_crossing(2, 0, 0.5, 0);
  const std::vector<Holder> after = granted(map_, {ahead, behind});
  EXPECT_LT(after[1].claim.ahead_m, 1.5 - 0.24);
  EXPECT_GT(after[1].claim.ahead_m, 1.5 - 0.24 - 0.08);
}

// Two that both missed a vehicle far away would wait for each other for good.
TEST_F(GrantAtACrossing, WhoMissesAVehicleThatCannotMatterTakesWhatIsGranted) {
  const std::vector<Holder> holders{before_crossing(1, 0, 0.5, 3), before_crossing(2, 1, 0.5, 3)};
  const auto taken = [&](std::span<const Holder> received, double missing_before_m) {
    const std::vector<Missing> missing{{.last = before_crossing(3, 1, missing_before_m, 0)}};
    return cautious_grant(map_, received, missing, {}, kLookAhead_m, {1});
  };
  EXPECT_FALSE(taken(holders, -1.5)) << "it has left the crossing";
  EXPECT_FALSE(taken(holders, 1.0)) << "it is behind vehicle 2";
  const auto cautious = taken(std::span(holders).first(1), 1.0);
  ASSERT_TRUE(cautious);
  EXPECT_LT(cautious->front().claim.ahead_m, 0.5);
}

TEST(Grant, NothingIsGrantedWhereTheWholeRouteIsInConflict) {
  const ConflictMap map({{circle({0.0, 0.0}, 1.0), circle({0.0, 0.0}, 1.0, -1.0)}}, kCar);
  const Holder one{.vehicle = {1}, .claim = {.place_m = 1.0, .ahead_m = 0.25}};
  EXPECT_EQ(grant(map, {&one, 1}, {}, kLookAhead_m), std::vector{0.25});
}

// Two cars that had entered a merge side by side, after a message was lost, stood there for good.
TEST(Grant, OfTwoVehiclesWhosePlacesOverlapTheOneAheadGetsOn) {
  const ConflictMap map({{loop_beside_lane(1.0), loop_beside_lane(-1.0)}}, kCar);
  for (const std::uint8_t ahead : std::array<std::uint8_t, 2>{1, 2}) {
    for (const std::uint32_t waits : {0U, 9U}) {
      const std::vector<Holder> both = granted(
          map,
          {{.vehicle = {ahead}, .claim = {.route = 0, .place_m = map.length_m(0) - 0.05}},
           {.vehicle = {static_cast<std::uint8_t>(3 - ahead)},
            .claim = {.route = 1, .place_m = map.length_m(1) - 0.15, .waiting_steps = waits}}});
      EXPECT_GT(both[0].claim.ahead_m, 0.5) << waits;
      EXPECT_EQ(both[1].claim.ahead_m, 0.0) << waits;
    }
  }
}

TEST(CautiousGrant, AMissingVehicleMayHaveGotOnFromAPlaceThatOverlaps) {
  const ConflictMap map({{loop_beside_lane(1.0), loop_beside_lane(-1.0)}}, kCar);
  const Holder own{.vehicle = {1}, .claim = {.route = 1, .place_m = map.length_m(1) - 0.15}};
  const Missing ahead{
      .last = {.vehicle = {2}, .claim = {.route = 0, .place_m = map.length_m(0) - 0.05}},
      .moved_m = 0.2};
  const auto all = cautious_grant(map, {&own, 1}, {&ahead, 1}, {}, kLookAhead_m, {1});
  ASSERT_TRUE(all.has_value());
  EXPECT_GT(all->back().claim.ahead_m, kLookAhead_m) << "what it may hold";
  EXPECT_EQ(all->front().claim.ahead_m, 0.0);
}

TEST(WithheldBy, AVehicleBehindWithholdsNothingWithItsPlace) {
  const ConflictMap map({{loop_beside_lane(1.0), loop_beside_lane(-1.0)}}, kCar);
  const std::array both{
      Holder{.vehicle = {1}, .claim = {.route = 0, .place_m = map.length_m(0) - 0.05}},
      Holder{.vehicle = {2}, .claim = {.route = 1, .place_m = map.length_m(1) - 0.15}}};
  EXPECT_TRUE(withheld_by(map, both, {}, 0).empty());
  EXPECT_EQ(withheld_by(map, both, {}, 1), std::vector<VehicleId>{{1}});
}

TEST(Grant, OfTwoVehiclesWhosePlacesOverlapAnywhereOneGetsOn) {
  const ConflictMap& map = *lab_cars().conflicts;
  std::size_t num_pairs = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(500); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto one = static_cast<std::uint32_t>(random() % map.num_routes());
    const auto two = static_cast<std::uint32_t>(random() % map.num_routes());
    const std::size_t cell = random() % map.num_cells(one);
    for (std::size_t other = 0; other < map.num_cells(two); ++other) {
      if (!std::ranges::binary_search(map.overlaps(one, cell), map.cell(two, other))) continue;
      const auto place_m = [&](std::uint32_t route, std::size_t at) {
        return static_cast<double>(at) * map.cell_m(route);
      };
      const std::vector<Holder> both =
          granted(map, {{.vehicle = {1}, .claim = {.route = one, .place_m = place_m(one, cell)}},
                        {.vehicle = {2}, .claim = {.route = two, .place_m = place_m(two, other)}}});
      EXPECT_GT(std::max(both[0].claim.ahead_m, both[1].claim.ahead_m), 0.5) << other;
      ++num_pairs;
    }
  }
  EXPECT_GT(num_pairs, 100U);
}

// Ten cars stood in a knot for good after a tenth of the messages had been lost.
TEST(CautiousGrant, NoTwoVehiclesHoldOverlappingCellsWhateverIsLost) {
  std::size_t num_cautious = 0;
  const std::uint64_t num_seeds = test::num_costly_seeds(8);
  for (std::uint64_t seed = 1; seed <= num_seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const scenario::Scenario drawn = scenario::with_random_starts(lab_cars(), seed);
    RandomTraffic traffic(drawn, seed, kLookAhead_m);
    for (int step = 0; step < 150; ++step) {
      // Few losses, so that in many steps some have received all and others have not.
      num_cautious +=
          traffic.step_with_losses(step % 2 == 0 ? 0.005 : 0.1, seed % 2 == 0 ? 0.1 : 0.01);
      ASSERT_TRUE(are_disjoint(*drawn.conflicts, traffic.holders())) << "step " << step;
    }
  }
  EXPECT_GT(num_cautious, 125 * num_seeds);
}

TEST(Grant, NoneOfTwentyCarsOfTheLabWaitsForever) {
  std::uint32_t longest = 0;
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(8); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const scenario::Scenario drawn = scenario::with_random_starts(lab_cars(), seed);
    RandomTraffic traffic(drawn, seed, kLookAhead_m);
    std::uint32_t longest_of_draw = 0;
    for (int step = 0; step < 2000; ++step) {
      longest_of_draw = std::max(longest_of_draw, traffic.step());
    }
    EXPECT_LT(longest_of_draw, 500U) << "measured: at most 162";
    longest = std::max(longest, longest_of_draw);
    EXPECT_TRUE(are_disjoint(*drawn.conflicts, traffic.holders()));
  }
  EXPECT_GT(longest, 10U) << "nobody ever waited: nothing was tried";
  RecordProperty("longest_wait_steps", static_cast<int>(longest));
}

}  // namespace
}  // namespace hlc::right_of_way
