#include "planner/right_of_way/reservation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planner/right_of_way/queues.hpp"
#include "planner/right_of_way/way_on.hpp"
#include "tests/planner/right_of_way/held_cells.hpp"
#include "tests/planner/right_of_way/random_traffic.hpp"
#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::right_of_way::reservation_test {
namespace {

constexpr double kLookAhead_m = 1.0;
constexpr std::uint64_t kSeed = 2;  // of the speeds
constexpr std::uint32_t kFrom_steps = 50;
constexpr std::uint32_t kUntil_steps = 150;

/// A step's grants and what of them is reserved.
struct Case {
  const ConflictMap& map;
  const std::vector<Holder>& holders;
  std::vector<double> granted_m;
  Reserved reserved;

  Case(const ConflictMap& map, const std::vector<Holder>& holders)
      : map(map),
        holders(holders),
        granted_m(grant(map, holders, {}, kLookAhead_m)),
        reserved(reserve(map, holders, granted_m, {}, kLongestWait)) {}

  [[nodiscard]] std::size_t reserver() const {
    return static_cast<std::size_t>(
        std::ranges::find(holders, reserved.vehicle.value(), &Holder::vehicle) - holders.begin());
  }
  [[nodiscard]] bool is_kept_out(std::size_t who) const {
    return std::ranges::find(reserved.kept_out, who) != reserved.kept_out.end();
  }
};

/// Vehicles that would be granted road in the reserved cells, and stand in one of them.
std::size_t num_leaving(const Case& one) {
  const std::vector<bool> cells =
      overlapping_next_stretch(one.map, one.holders[one.reserver()].claim);
  std::size_t num = 0;
  for (std::size_t who = 0; who < one.holders.size(); ++who) {
    const coordination::LaneClaim& claim = one.holders[who].claim;
    const auto taken = cells_of(one.map, one.holders[who], claim.ahead_m, one.granted_m[who]);
    const auto is_in = [&](std::size_t i) { return cells[one.map.cell(claim.route, i)]; };
    const bool goes_on = taken.size() > 1 && is_in(taken[0]) && is_in(taken[1]);
    EXPECT_TRUE(!goes_on || !one.is_kept_out(who)) << who;
    num += goes_on ? 1U : 0U;
  }
  return num;
}

void expect_only_that_kept_free(const Case& one) {
  const std::size_t reserver = one.reserver();
  const Holder& first = one.holders[reserver];
  EXPECT_GE(first.claim.waiting_steps, kFrom_steps);
  EXPECT_LT(first.claim.waiting_steps, kUntil_steps);
  EXPECT_EQ(one.granted_m[reserver], first.claim.ahead_m);
  const std::vector<bool> cells = overlapping_next_stretch(one.map, first.claim);
  const auto is_in = [&](std::size_t route, std::size_t i) {
    return cells[one.map.cell(route, i)];
  };
  for (std::size_t who = 0; who < one.holders.size(); ++who) {
    const coordination::LaneClaim& claim = one.holders[who].claim;
    const double end_m = one.reserved.ahead_m[who];
    EXPECT_EQ(end_m < one.granted_m[who], one.is_kept_out(who)) << who;
    if (!one.is_kept_out(who)) continue;
    EXPECT_FALSE(kLongestWait.is_before(one.holders[who], first)) << who;
    EXPECT_GE(end_m, claim.ahead_m) << who;
    const auto taken = cells_of(one.map, one.holders[who], claim.ahead_m, end_m);
    for (const std::size_t i : taken) EXPECT_FALSE(is_in(claim.route, i)) << who;
    EXPECT_TRUE(taken.size() == 1 || !one.map.is_conflict(claim.route, taken.back())) << who;
    const auto granted = cells_of(one.map, one.holders[who], claim.ahead_m, one.granted_m[who]);
    EXPECT_TRUE(std::ranges::any_of(granted, [&](auto i) { return is_in(claim.route, i); })) << who;
  }
  const Queues then(one.map, one.holders, one.reserved.ahead_m, {});
  EXPECT_TRUE(then.passes_if_reserved(reserver, cells));
}

std::vector<double> ends_of(const std::vector<Holder>& holders) {
  std::vector<double> ahead_m;
  for (const Holder& one : holders) ahead_m.push_back(one.claim.ahead_m);
  return ahead_m;
}

void expect_reason_named(const Case& one) {
  const std::vector<Taken> taken =
      leave_a_way_on(one.map, one.holders, one.granted_m, {}, kLongestWait);
  for (std::size_t who = 0; who < taken.size(); ++who) {
    EXPECT_LE(taken[who].ahead_m, one.reserved.ahead_m[who]);
    EXPECT_EQ(taken[who].kept_out_for, one.is_kept_out(who) ? one.reserved.vehicle : std::nullopt);
  }
}

// Without reserved road cars on these tours stand for up to 53 s.
TEST(Reservation, WhoHasWaitedLongFindsItsWayFreeBeforeThoseThatCameLater) {
  const scenario::Scenario& drawn = lab_cars_on_tours();
  RandomTraffic traffic(drawn, kSeed, kLookAhead_m);
  std::uint32_t longest = 0;
  std::size_t num_reserved = 0;
  std::size_t num_kept_out = 0;
  std::size_t num_leaves = 0;
  std::size_t num_not_reserved = 0;
  for (int step = 0; step < 3000; ++step) {
    longest = std::max(longest, traffic.step());
    const bool waits = std::ranges::any_of(
        traffic.before(), [](const Holder& one) { return one.claim.waiting_steps >= kFrom_steps; });
    if (!waits) continue;
    SCOPED_TRACE(step);
    const Case one(*drawn.conflicts, traffic.before());
    expect_reason_named(one);
    num_kept_out += one.reserved.kept_out.size();
    if (!one.reserved.vehicle) {
      ++num_not_reserved;
      continue;
    }
    ++num_reserved;
    num_leaves += num_leaving(one);
    expect_only_that_kept_free(one);
    const Queues then(one.map, one.holders, ends_of(traffic.holders()), {});
    EXPECT_EQ(then.num_in_circles(), 0U);
  }
  EXPECT_LT(longest, 200U);
  EXPECT_GT(num_reserved, 0U) << "nothing was tried";
  EXPECT_GT(num_kept_out, 0U) << "nothing was tried";
  EXPECT_GT(num_leaves, 0U) << "nothing was tried";
  EXPECT_GT(num_not_reserved, 0U) << "nothing was tried";
}

TEST(Reservation, NothingIsReservedForWhoHasJustStopped) {
  const scenario::Scenario& drawn = lab_cars_on_tours();
  RandomTraffic traffic(drawn, kSeed, kLookAhead_m, kFrom_steps - 1);
  for (int step = 0; step < 400; ++step) {
    static_cast<void>(traffic.step());
    const Case one(*drawn.conflicts, traffic.before());
    EXPECT_FALSE(one.reserved.vehicle) << step;
    EXPECT_EQ(one.reserved.ahead_m, one.granted_m) << step;
    EXPECT_TRUE(one.reserved.kept_out.empty()) << step;
  }
}

/// Three cars of the figure eight: the first one waits before the crossing, the second one stands
/// behind it in the cell in which the first one's stretch ends, and can drive on. The third one
/// waits before the crossing, too, on the lane across.
class AtACrossing : public testing::Test {
 protected:
  AtACrossing() {
    const auto middle = static_cast<std::int64_t>(map_.num_cells(0)) / 2;
    set_place(0, next_free(middle, -1));
    set_place(1, next_free(middle, 1));
    set_place(2, next_free(0, -1));
    holders_[0].claim.waiting_steps = kFrom_steps;
    holders_[2].claim.waiting_steps = 10;
  }

  /// The first cell in this direction that is no conflict cell.
  [[nodiscard]] std::int64_t next_free(std::int64_t cell, std::int64_t direction) const {
    while (map_.is_conflict(0, map_.index_of(0, cell))) cell += direction;
    return cell;
  }
  void set_place(std::size_t who, std::int64_t cell) {
    const auto index = static_cast<double>(map_.index_of(0, cell));
    holders_[who].claim.place_m = index * map_.cell_m(0);
  }
  [[nodiscard]] std::vector<double> granted() const {
    return grant(map_, holders_, blocked_, kLookAhead_m);
  }
  [[nodiscard]] std::vector<std::size_t> kept_out() const {
    return reserve(map_, holders_, granted(), blocked_, kLongestWait).kept_out;
  }

  ConflictMap map_{std::vector{figure_eight()}, kCar};
  std::vector<Holder> holders_{
      {.vehicle = {1}, .claim = {}}, {.vehicle = {2}, .claim = {}}, {.vehicle = {3}, .claim = {}}};
  std::vector<Blocked> blocked_;
};

TEST_F(AtACrossing, WhoCameLaterIsKeptOutUntilTheFirstOneHasStoodForLong) {
  for (std::uint32_t step = 0; step < kUntil_steps + 20; ++step) {
    holders_[0].claim.waiting_steps = std::max(11U, step);
    ASSERT_EQ(granted()[0], 0.0);
    ASSERT_GT(granted()[2], 0.0);
    const bool is_reserved = step >= kFrom_steps && step < kUntil_steps;
    EXPECT_EQ(kept_out(), is_reserved ? std::vector<std::size_t>{2} : std::vector<std::size_t>{})
        << step;
  }
}

TEST_F(AtACrossing, WhoHasWaitedLongerIsNotKeptOut) {
  holders_[2].claim.waiting_steps = kFrom_steps + 1;
  ASSERT_GT(granted()[2], 0.0);
  EXPECT_TRUE(kept_out().empty());
}

TEST_F(AtACrossing, WhoIsOnItDrivesOn) {
  set_place(2, next_free(0, -1) + 1);
  ASSERT_GT(granted()[2], 0.0);
  EXPECT_TRUE(kept_out().empty());
}

TEST_F(AtACrossing, NobodyIsKeptOutForOneWhoseWayCannotBecomeFree) {
  const std::int64_t second = map_.count_at(0, holders_[1].claim.place_m);
  blocked_.push_back({.vehicle = {}, .area_m = map_.area_m(0, map_.index_of(0, second + 1))});
  ASSERT_EQ(granted()[1], 0.0);
  ASSERT_GT(granted()[2], 0.0);
  EXPECT_TRUE(kept_out().empty());
}

}  // namespace
}  // namespace hlc::right_of_way::reservation_test
