#include "planner/controller/making_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "planner/controller/followed_plan.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/planner/controller/east_bound.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::making_room_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr StepIndex kNow{10};

ConvexPolygon square_at(double x) { return footprint_area({1.0, 1.0}, {x, 0.0, 0.0}); }

MATCHER_P(LiesAt, x, "") { return arg.vertices_m == square_at(x).vertices_m; }

/// Drives from 0 over 1 to 2 in the steps 10 to 12, reaches as far as 9.
const coordination::Traffic kDrives{
    .vehicle = {1},
    .step = kNow,
    .running = {.first = kNow,
                .areas_m = {square_at(0.0), square_at(1.0), square_at(2.0)},
                .final_area_m = square_at(2.0)},
    .reachable_area_m = square_at(9.0)};

/// Plans to 5, desires to drive to 6 and 7.
const coordination::Prediction kDesires{
    .vehicle = {1},
    .step = kNow,
    .is_new = true,
    .areas = {.first = {11}, .areas_m = {}, .final_area_m = square_at(5.0)},
    .desired = coordination::OccupiedAreas{
        .first = {11}, .areas_m = {square_at(6.0)}, .final_area_m = square_at(7.0)}};

std::vector<ConvexPolygon> areas_m(const CoupledVehicle& other, std::uint64_t step) {
  std::vector<ConvexPolygon> areas;
  desired_plans_of_predecessors(other, {step}, areas);
  return areas;
}

TEST(DesiredPlansOfPredecessors, HoldASuccessorForOneStepOnly) {
  const CoupledVehicle successor{&kDrives, nullptr, false};
  EXPECT_THAT(areas_m(successor, 11), ElementsAre(LiesAt(1.0)));
  EXPECT_THAT(areas_m(successor, 12), IsEmpty());
}

TEST(DesiredPlansOfPredecessors, HoldWhatAPredecessorPlansAndDesires) {
  EXPECT_THAT(areas_m({&kDrives, &kDesires, true}, 11), ElementsAre(LiesAt(5.0), LiesAt(6.0)));
  EXPECT_THAT(areas_m({&kDrives, &kDesires, true}, 19), ElementsAre(LiesAt(5.0), LiesAt(7.0)));
  coordination::Prediction content = kDesires;
  content.desired.reset();
  EXPECT_THAT(areas_m({&kDrives, &content, true}, 11), ElementsAre(LiesAt(5.0)));
  EXPECT_THAT(areas_m({&kDrives, nullptr, true}, 11), ElementsAre(LiesAt(9.0)))
      << "not received: all that it can reach";
}

TEST(MakingRoom, AddsTheDesiredPlansFromTheGivenStepOn) {
  search::HorizonProblem problem;
  problem.reference_m.resize(3);
  problem.obstacles_m = {{square_at(0.0)}, {}, {}};
  const std::vector<const coordination::OccupiedAreas*> desired{&*kDesires.desired};
  EXPECT_THAT(making_room(problem, desired, {11}, 0).obstacles_m,
              ElementsAre(ElementsAre(LiesAt(0.0), LiesAt(6.0)), ElementsAre(LiesAt(7.0)),
                          ElementsAre(LiesAt(7.0))));
  EXPECT_THAT(making_room(problem, desired, {11}, 2).obstacles_m,
              ElementsAre(ElementsAre(LiesAt(0.0)), IsEmpty(), ElementsAre(LiesAt(7.0))));
}

// Whatever a vehicle claims to desire, the other one has a plan, and the two plans do not meet.
TEST(MakingRoom, SenselessDesiresDoNoHarm) {
  using namespace east_bound;
  for (unsigned seed = 0; seed < test::num_seeds(10); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x_m(-1.0, 4.0);
    std::uniform_real_distribution<double> size_m(0.05, 2.0);
    const auto one = controller(1, 0.3);
    const auto two = controller(2, 0.0);
    static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.3)})));
    static_cast<void>(two->stand_by(at(100, {seen(2, 0.0, 0.0)})));
    for (std::uint64_t k = 101; k < 121; ++k) {
      const Observation observation = at(k, {on_its_plan(*one, {k}), on_its_plan(*two, {k})});
      const coordination::Traffic t1 = one->observe(observation);
      const coordination::Traffic t2 = two->observe(observation);
      one->couple(std::vector{t2});
      two->couple(std::vector{t1});
      coordination::Prediction p1 = one->plan({});
      p1.desired = {.first = {k + 1},
                    .areas_m = {},
                    .final_area_m =
                        footprint_area({size_m(random), size_m(random)}, {x_m(random), 0.0, 0.5})};
      const coordination::Prediction p2 = two->plan(std::vector{p1});
      static_cast<void>(one->commit(std::vector{p2}, {}));
      const coordination::Report report = two->commit(std::vector{p1}, {});
      EXPECT_TRUE(p2.is_new) << k << ": " << to_string(report.reason);
      ASSERT_TRUE(coordination::are_free(one->plan_in_force().areas_from({k}),
                                         two->plan_in_force().areas_from({k}), {k}, 10))
          << k;
    }
  }
}

}  // namespace
}  // namespace hlc::controller::making_room_test
