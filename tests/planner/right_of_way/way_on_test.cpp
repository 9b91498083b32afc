#include "planner/right_of_way/way_on.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/right_of_way/queues.hpp"
#include "tests/planner/right_of_way/random_traffic.hpp"
#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::right_of_way::way_on_test {
namespace {

constexpr double kLookAhead_m = 1.0;
constexpr std::uint64_t kSeed = 2;  // of the speeds
/// Where road is reserved for who has waited longer, nobody declines in these runs.
constexpr std::uint32_t kNoneReserved_steps = 49;

std::vector<double> ends_of(const std::vector<Holder>& holders) {
  std::vector<double> ahead_m;
  for (const Holder& one : holders) ahead_m.push_back(one.claim.ahead_m);
  return ahead_m;
}

/// In steps of vehicles that drive to the ends of their authorities.
std::uint32_t longest_stand(const scenario::Scenario& drawn, std::uint64_t seed,
                            bool leaves_a_way_on) {
  RandomTraffic traffic(drawn, seed, kLookAhead_m, kNoneReserved_steps);
  std::uint32_t longest = 0;
  for (int step = 0; step < 3000; ++step) {
    longest = std::max(longest, traffic.step(leaves_a_way_on));
  }
  return longest;
}

// In six of 13 runs of 600 s with twenty cars on tours, a car stood at the end that had waited for
// up to 241 s: lanes were full, and each car waited for the next one to leave its lane.
TEST(WayOn, CarsOnToursDoNotWaitForEachOtherAroundACircleOfFullLanes) {
  constexpr std::uint32_t kMany = 600;
  const scenario::Scenario& drawn = lab_cars_on_tours();
  EXPECT_GT(longest_stand(drawn, kSeed, false), kMany) << "they got on without";
  EXPECT_LT(longest_stand(drawn, kSeed, true), kMany);
}

// Who declines where the order does not put those first that wait might be granted the same again
// and again, and nobody else.
TEST(WayOn, NothingIsTakenThatWasNotGrantedAndNoCircleIsClosed) {
  constexpr int kFullLanes = 650;  // steps until they are
  const scenario::Scenario& drawn = lab_cars_on_tours();
  const ConflictMap& map = *drawn.conflicts;
  RandomTraffic traffic(drawn, kSeed, kLookAhead_m, kNoneReserved_steps);
  std::size_t num_declined = 0;
  for (int step = 0; step < kFullLanes + 200; ++step) {
    static_cast<void>(traffic.step());
    if (step < kFullLanes) continue;
    const std::vector<Holder>& before = traffic.before();
    const std::vector<Holder>& after = traffic.holders();
    const Queues queues(map, before, ends_of(after), {});
    ASSERT_EQ(queues.num_in_circles(), 0U) << "step " << step;
    for (const GrantOrder* order : grant_orders()) {
      const std::vector<double> granted = grant(map, before, {}, kLookAhead_m, *order);
      const std::vector<Taken> taken = leave_a_way_on(map, before, granted, {}, *order);
      for (std::size_t i = 0; i < taken.size(); ++i) {
        EXPECT_TRUE(order != &kLongestWait || taken[i].ahead_m == after[i].claim.ahead_m);
        EXPECT_GE(taken[i].ahead_m, before[i].claim.ahead_m);
        EXPECT_LE(taken[i].ahead_m, granted[i]);
        EXPECT_EQ(taken[i].declines, taken[i].ahead_m < granted[i]) << "vehicle " << i;
        EXPECT_EQ(std::ranges::count(taken[i].declined_for, before[i].vehicle), 0);
        EXPECT_TRUE(order->puts_waiting_first || !taken[i].declines) << order->name;
        num_declined += taken[i].declines ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(num_declined, 0U) << "nothing was tried";
}

TEST(WayOn, AloneACarTakesAllThatIsGranted) {
  const scenario::Scenario& drawn = lab_cars();
  const std::vector<Holder> alone{{.vehicle = {7}, .claim = {.route = 3, .place_m = 2.0}}};
  for (int quarters = 0; quarters < 16; ++quarters) {
    const double ahead_m = 0.25 * quarters;
    const std::vector<double> granted{ahead_m};
    EXPECT_EQ(
        leave_a_way_on(*drawn.conflicts, alone, granted, {}),
        (std::vector<Taken>{
            {.ahead_m = ahead_m, .declines = false, .declined_for = {}, .kept_out_for = {}}}));
  }
}

}  // namespace
}  // namespace hlc::right_of_way::way_on_test
