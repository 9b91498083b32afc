#include "planner/controller/held_up.hpp"

#include <gtest/gtest.h>

#include "planner/controller/self_loop.hpp"
#include "tests/planner/controller/car_and_intruder.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::held_up_test {
namespace {

using right_of_way::lab_cars;

const PreparedSubgraph& prepared() {
  static const PreparedSubgraph kPrepared = scenario::prepare_subgraph_of(lab_cars());
  return kPrepared;
}

TEST(HeldUpCar, StaysInItsLaneBehindWhoeverReachesIntoIt) {
  const std::uint64_t num_cars = test::num_costly_seeds(30);
  std::uint64_t num_held_up = 0;
  for (std::uint64_t seed = 0; seed < num_cars; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    const VehicleId vehicle = draw.vehicle();
    const double place_m = draw.place_m();
    CarAndIntruder car(lab_cars(), prepared(), vehicle, place_m);
    const ConvexPolygon area_m =
        intruder_m(car, place_m + draw.uniform(0.4, 0.6), draw.uniform(-0.06, 0.06));
    const Point start_m = car.controller().plan_in_force().pose_at({100}).position_m();
    for (int i = 0; i < 6; ++i) car.step(area_m);
    const double led_m = (car.end().position_m() - start_m).norm();
    if (led_m > 0.4) continue;  // it has passed
    ++num_held_up;
    EXPECT_LT(car.offset_m(), 0.030) << led_m;
  }
  EXPECT_GT(3 * num_held_up, num_cars) << num_held_up << " of " << num_cars;
}

/// Most of 300 such cars (seeds 0 to 299) never could: these do in one of their steps.
TEST(HeldUpCar, CreepsIfOnlyTheFirstPlanGetsOn) {
  const automaton::ReachableSets& reachable = *prepared().reachable;
  std::size_t num_creeping = 0;
  for (const std::uint64_t seed : {36U, 90U, 101U, 108U, 128U, 149U, 154U, 253U, 269U}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    const VehicleId vehicle = draw.vehicle();
    const double place_m = draw.place_m();
    CarAndIntruder car(lab_cars(), prepared(), vehicle, place_m);
    const double beside_m = draw.uniform(-0.16, 0.16);
    const ConvexPolygon area_m = intruder_m(car, place_m + draw.uniform(0.2, 0.6), beside_m);
    const auto led_m = [&](const SearchedProblem& searched) {
      const auto engine = search::make_search_engine(*searched.subgraph, reachable,
                                                     {.max_expansions = searched.max_expansions});
      const search::SearchResult found = engine->search(searched.problem);
      if (found.poses.empty()) return 0.0;
      return (found.poses.back().position_m() - searched.problem.start.position_m()).norm();
    };
    for (int i = 0; i < 8; ++i) {
      car.step(area_m);
      const auto problems = car.controller().problems();
      if (problems.size() != 2) continue;
      const double other_m = led_m(problems[0]);
      const double taken_m = led_m(problems[1]);
      EXPECT_TRUE(other_m < 1e-3 || taken_m > 1e-3) << "it stands, and could lead " << other_m;
      num_creeping += other_m < 1e-3 && taken_m > 1e-3 ? 1U : 0U;
    }
  }
  EXPECT_GT(num_creeping, 5U) << "nothing was tried";
}

/// Standing at arc length s of a ring of 12.6 m.
class HeldUpAt : public testing::Test {
 protected:
  [[nodiscard]] std::optional<double> at_m(double s_m, double reference_s_m) {
    const auto pose_on = [&](double at_m) {
      const Point point_m = tracker_.route().path.at(at_m);
      return Pose{point_m.x(), point_m.y(), tracker_.route().path.heading_rad_at(at_m)};
    };
    tracker_.select_route(pose_on(s_m - 0.3), {0.22, 0.107});
    const automaton::Subgraph& on = *lab_cars().subgraph;
    const coordination::Plan standing({1}, pose_on(s_m),
                                      self_loop(on.automaton(), on.standstill()));
    search::HorizonProblem problem;
    problem.reference_m.push_back(pose_on(reference_s_m).position_m());
    return held_up_at_m(standing, {1}, problem, tracker_, 2.0);
  }

  RouteTracker tracker_{std::make_shared<const std::vector<road::DrivableRoute>>(
      1, right_of_way::circle({0.0, 0.0}, 2.0))};
};

TEST_F(HeldUpAt, IsNoPlaceForAPlanThatGetsAboutAsFarAsTheReference) {
  EXPECT_FALSE(at_m(3.0, 3.0 + 0.9 * kHeldUp_m));
  EXPECT_FALSE(at_m(3.0, 2.9)) << "it gets farther";
}

TEST_F(HeldUpAt, IsWhereThePlanEndsCountedOnOverTheEndOfTheRoute) {
  EXPECT_NEAR(at_m(3.0, 4.0).value(), 3.0, 1e-3);
  const double length_m = tracker_.route().path.length_m();
  EXPECT_NEAR(at_m(0.1, 1.0).value(), length_m + 0.1, 1e-3);
  EXPECT_NEAR(at_m(length_m - 0.1, 0.5).value(), length_m - 0.1, 1e-3);
}

}  // namespace
}  // namespace hlc::controller::held_up_test
