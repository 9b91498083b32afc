#include "planner/controller/plan_end.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/controller/self_loop.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::plan_end_test {
namespace {

constexpr double kReach_m = 2.0;
constexpr StepIndex kNext{5};

/// A ring of 12.6 m, and plans of vehicles that stand on it.
class PlanEnd : public testing::Test {
 protected:
  void SetUp() override { tracker_.select_route(on_ring(0.0, 0.0), {}); }

  [[nodiscard]] Pose on_ring(double s_m, double turned_rad) const {
    const road::ReferencePath& path = tracker_.route().path;
    const Point point_m = path.at(s_m);
    return {point_m.x(), point_m.y(), road::chord_heading_rad(path, s_m, 0.01) + turned_rad};
  }
  [[nodiscard]] coordination::Plan standing(double s_m, double turned_rad) const {
    return {{1}, on_ring(s_m, turned_rad), self_loop(*automaton::paper_automaton(), {0})};
  }
  [[nodiscard]] bool may_replace(const coordination::Plan& in_force,
                                 const coordination::Plan& candidate) const {
    return ends_along_lane(candidate, in_force, kNext, tracker_, kReach_m);
  }

  RouteTracker tracker_{std::make_shared<const std::vector<road::DrivableRoute>>(
      1, right_of_way::circle({0.0, 0.0}, 2.0))};
};

TEST_F(PlanEnd, TheAngleIsThatToThePathWhereThePlanEnds) {
  const automaton::UniversalAutomaton& automaton = *automaton::paper_automaton();
  const coordination::Plan turning = standing(0.5, 0.0).continued(
      kNext, {automaton.find({0}, {6}, "J2"), automaton.find({6}, {0}, "J2")});
  // Straight on, on a ring of 2 m: as far as it gets, divided by the radius.
  const double driven_m =
      (turning.pose_at(turning.end()).position_m() - turning.pose_at(kNext).position_m()).norm();
  EXPECT_GT(driven_m, 0.1);
  EXPECT_NEAR(turned_at_end_rad(turning, kNext, tracker_, kReach_m), driven_m / 2.0, 1e-3);
}

TEST_F(PlanEnd, OneMayReplaceAnotherIfItIsAlongTheLaneOrTurnedNoFarther) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(500); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> s_m(0.3, 1.5);
    std::uniform_real_distribution<double> angle_rad(-1.0, 1.0);
    const double old_rad = angle_rad(random);
    const double new_rad = angle_rad(random);
    const double old_s_m = s_m(random);
    const double on_m = std::uniform_real_distribution(-0.2, 0.3)(random);
    const coordination::Plan in_force = standing(old_s_m, old_rad);
    const coordination::Plan candidate = standing(old_s_m + on_m, new_rad);
    EXPECT_NEAR(turned_at_end_rad(candidate, kNext, tracker_, kReach_m), std::abs(new_rad), 0.01);
    EXPECT_TRUE(may_replace(in_force, in_force));
    const double most_rad = std::max(kMostTurned_rad, std::abs(old_rad));
    // The path is a polyline.
    if (std::abs(std::abs(new_rad) - most_rad) < 0.02) continue;
    EXPECT_EQ(may_replace(in_force, candidate), std::abs(new_rad) < most_rad);
  }
}

}  // namespace
}  // namespace hlc::controller::plan_end_test
