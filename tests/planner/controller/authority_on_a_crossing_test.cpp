// The authority of a vehicle on a road that crosses itself.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "planner/controller/authority.hpp"
#include "planner/controller/shared_step.hpp"
#include "tests/planner/controller/ring.hpp"
#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::controller::authority_on_a_crossing_test {
namespace {

using coordination::Traffic;

constexpr double kReach_m = 2.0;

/// So far before the crossing of the figure eight, half a lap from its begin.
double before_crossing_m(double way_m) {
  return 0.5 * right_of_way::figure_eight().path.length_m() - way_m;
}

TEST(AuthorityOnACrossing, RoadThatIsNotUsedIsGivenBackAndWaitedForAnew) {
  const double s_m = before_crossing_m(0.5);
  const Ring eight(right_of_way::figure_eight(), s_m);
  Authority authority(eight.map);
  const std::uint64_t last = 1 + Authority::kPatience_steps;
  for (std::uint64_t step = 1; step <= last; ++step) {
    authority.begin_step(eight.standing(s_m), {step}, eight.tracker, kReach_m);
    EXPECT_EQ(authority.claim().waiting_steps, step == last ? 0 : step - 1);
    EXPECT_EQ(authority.claim().ahead_m > 0.5, step > 1 && step < last) << step;
    SharedStep shared;
    authority.extend({1}, {}, {}, {}, 0.0, shared);
  }
  EXPECT_GT(authority.claim().ahead_m, 0.5) << "nobody else has taken it";
}

// Where it kept its road, a run of ten cars ended in a knot: one waited for 242 s.
TEST(AuthorityOnACrossing, WhoStandsInAConflictCellGivesUnusedRoadBackToo) {
  std::size_t num_conflicts = 0;
  for (const double s_m : {0.02, 0.1, 1.0, 1.5}) {
    const Ring eight(right_of_way::figure_eight(), s_m);
    Authority authority(eight.map);
    std::size_t num_given_back = 0;
    for (std::uint64_t step = 1; step <= 2 + Authority::kPatience_steps; ++step) {
      authority.begin_step(eight.standing(s_m), {step}, eight.tracker, kReach_m);
      num_given_back += step > 1 && authority.claim().ahead_m < 0.1 ? 1U : 0U;
      SharedStep shared;
      authority.extend({1}, {}, {}, {}, 0.0, shared);
    }
    EXPECT_EQ(num_given_back, 1U) << s_m;
    num_conflicts += eight.map->is_conflict(0, eight.map->index_of(0, eight.map->count_at(0, s_m)));
  }
  EXPECT_EQ(num_conflicts, 2U);
}

TEST(AuthorityOnACrossing, AMissingVehicleIsAssumedToTakeWhatItCanReach) {
  struct Silence {
    double step_m;
    std::uint64_t until;  ///< from step 1 on; steps in between are skipped
    bool takes;
  };
  for (const auto& [step_m, until, takes] :
       {Silence{0.1, 2, true}, Silence{0.5, 2, false}, Silence{0.1, 6, false}}) {
    const Ring at_zero(right_of_way::figure_eight());
    const double length_m = at_zero.path().length_m();
    const Ring eight(right_of_way::figure_eight(), length_m - 0.6);
    const coordination::Plan plan = eight.standing(length_m - 0.6);
    const Traffic other = Ring::other_at(2, length_m / 2.0 - 1.6);
    const Traffic on_crossing = Ring::other_at(3, 0.0);
    const Traffic beyond = Ring::other_at(3, 1.5);
    Authority authority(eight.map);
    SharedStep shared;
    authority.begin_step(plan, {1}, eight.tracker, kReach_m);
    const std::array received{&other, &on_crossing};
    authority.receive(received);
    authority.extend({1}, received, {}, {}, step_m, shared);
    EXPECT_LT(authority.claim().ahead_m, 0.6);
    authority.begin_step(plan, {until}, eight.tracker, kReach_m);
    authority.extend({1}, std::array{&beyond}, std::array{other.vehicle}, {}, step_m, shared);
    EXPECT_EQ(authority.claim().ahead_m > 0.6, takes) << step_m << ' ' << until;
  }
}

// Without that its reason would be missing from reports, log and table.
TEST(AuthorityOnACrossing, WhoIsKeptOutWaitsForTheOneForWhichTheRoadIsReserved) {
  constexpr double kBefore_m = 0.5;
  const Ring at_zero(right_of_way::figure_eight());
  const double length_m = at_zero.path().length_m();
  const Ring eight(right_of_way::figure_eight(), length_m - kBefore_m);
  const auto next_free_m = [&](double s_m, std::int64_t direction) {
    std::int64_t cell = eight.map->count_at(0, s_m);
    while (eight.map->is_conflict(0, eight.map->index_of(0, cell))) cell += direction;
    return static_cast<double>(cell) * eight.map->cell_m(0);
  };
  Traffic first = Ring::other_at(2, next_free_m(0.5 * length_m, -1));
  const Traffic behind_crossing = Ring::other_at(3, next_free_m(0.5 * length_m, 1));
  for (const std::uint32_t waiting_steps : {10U, 60U}) {
    first.claim->waiting_steps = waiting_steps;
    Authority authority(eight.map);
    SharedStep shared;
    authority.begin_step(eight.standing(length_m - kBefore_m), {1}, eight.tracker, kReach_m);
    authority.extend({1}, std::array<const Traffic*, 2>{&first, &behind_crossing}, {}, {}, 0.0,
                     shared);
    const bool is_kept_out = waiting_steps == 60;
    EXPECT_EQ(authority.claim().ahead_m < kBefore_m, is_kept_out);
    EXPECT_EQ(authority.withheld_by(),
              is_kept_out ? std::vector<VehicleId>{{2}} : std::vector<VehicleId>{});
  }
}

}  // namespace
}  // namespace hlc::controller::authority_on_a_crossing_test
