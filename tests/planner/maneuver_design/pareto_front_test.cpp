#include "planner/maneuver_design/pareto_front.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/effort.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

/// The paper's Fig. 1: wider limits and L = 0.2 m.
ParetoProblem paper_example(std::size_t intervals, const std::vector<std::string>& criteria) {
  ParetoProblem problem;
  problem.maneuver = {{0.0, 0.0}, {2.3, 0.62}, 0.2, intervals, {}, {}};
  problem.maneuver.vehicle.wheelbase_m = 0.2;
  problem.maneuver.vehicle.rear_axle_to_cg_m = 0.1;
  problem.maneuver.limits.acceleration_mps2 = 20.0;
  problem.maneuver.limits.steering_rate_radps = 12.0;
  for (const std::string& name : criteria) {
    problem.criteria.push_back(make_criterion(name, problem.maneuver.vehicle));
  }
  return problem;
}

/// Scaled by the ranges.
std::vector<Objectives> scaled(const ParetoFront& front) {
  const std::vector<Objectives> points = front.objectives();
  const ObjectiveRange range = range_of(points);
  std::vector<Objectives> result;
  for (const Objectives& point : points) {
    result.push_back((point - range.best).cwiseQuotient(range.worst - range.best));
  }
  return result;
}

void expect_convex(const std::vector<Objectives>& points) {
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Objectives before = points[i] - points[i - 1];
    const Objectives after = points[i + 1] - points[i];
    EXPECT_LT(before(0) / before(1), after(0) / after(1) + 1e-3) << "point " << i;
  }
}

TEST(ParetoFront, OfThePapersExampleIsConvexEvenAndUndominatedBetweenTheReferenceEnds) {
  const ParetoFront front = epsilon_constraint_front(paper_example(50, {"J1", "J2"}));
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  ASSERT_EQ(front.points.size(), 31U);
  const Objectives& soft = front.points.front().objectives;
  const Objectives& far = front.points.back().objectives;
  EXPECT_NEAR(soft(0), -2.059e-3, 1e-3 * 2.059e-3);
  EXPECT_NEAR(soft(1), 28.37, 1e-3 * 28.37);
  EXPECT_NEAR(far(0), -6.012e-3, 1e-3 * 6.012e-3);
  EXPECT_NEAR(far(1), 90.81, 1e-3 * 90.81);
  for (const ParetoPoint& point : front.points) {
    EXPECT_EQ(point.solution.status, ManeuverStatus::kOptimal);
    EXPECT_LT(point.solution.first_order_residual, 1e-4);
    EXPECT_FALSE(point.is_dominated);
  }
  EXPECT_EQ(non_dominated(front.objectives()).size(), 31U);
  const std::vector<Objectives> points = scaled(front);
  expect_convex(points);
  double shortest = 10.0;
  double longest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    shortest = std::min(shortest, (points[i] - points[i - 1]).norm());
    longest = std::max(longest, (points[i] - points[i - 1]).norm());
  }
  EXPECT_LT(longest, 1.05 * shortest);
}

TEST(ParetoFront, EqualStepsOfTheSecondCriterionIfAskedFor) {
  ParetoOptions options;
  options.points = 9;
  options.spacing = Spacing::kSecondCriterion;
  std::size_t done = 0;
  options.progress = [&done](std::size_t count, std::size_t of) {
    EXPECT_EQ(count, done + 1);
    EXPECT_LE(count, of);
    done = count;
  };
  const ParetoFront front = epsilon_constraint_front(paper_example(20, {"J1", "J2"}), options);
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  ASSERT_EQ(front.points.size(), 9U);
  EXPECT_EQ(done, 2U * 7U);  // weighted sums first, to start from
  const double step =
      (front.points.back().objectives(1) - front.points.front().objectives(1)) / 8.0;
  for (std::size_t i = 1; i < 9; ++i) {
    EXPECT_NEAR(front.points[i].objectives(1) - front.points[i - 1].objectives(1), step,
                1e-6 * step);
  }
  expect_convex(scaled(front));
}

TEST(ParetoFront, WeightedSumsLieOnTheSameFrontButCrowd) {
  const ParetoProblem problem = paper_example(20, {"J1", "J2"});
  ParetoOptions options;
  options.points = 15;
  const ParetoFront even = epsilon_constraint_front(problem, options);
  const ParetoFront weighted = weighted_sum_front(problem, options);
  ASSERT_EQ(weighted.status, ManeuverStatus::kOptimal) << weighted.reason;
  ASSERT_EQ(weighted.points.size(), 15U);
  const ObjectiveRange range = range_of(even.objectives());
  const Objectives noise = 1e-4 * (range.worst - range.best);
  for (const ParetoPoint& a : weighted.points) {
    for (const ParetoPoint& b : even.points) {
      EXPECT_FALSE(dominates(a.objectives, b.objectives, noise));
      EXPECT_FALSE(dominates(b.objectives, a.objectives, noise));
    }
  }
  EXPECT_GT(hypervolume(even.objectives(), range.worst),
            hypervolume(weighted.objectives(), range.worst));
}

TEST(ParetoFront, ThreeCriteriaGiveASurfaceWhosePointsNoOtherDominates) {
  ParetoOptions options;
  options.points = 4;
  const ParetoFront front =
      epsilon_constraint_front(paper_example(10, {"J1", "J2", "comfort"}), options);
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  std::vector<Objectives> kept;
  for (const ParetoPoint& point : front.points) {
    EXPECT_LT(point.solution.residuals.cost_bound, 1e-8);
    if (!point.is_dominated) kept.push_back(point.objectives);
  }
  EXPECT_GE(kept.size(), 6U);
  const ObjectiveRange range = range_of(kept);
  EXPECT_GT(hypervolume(kept, range.worst), 0.0);
  EXPECT_LT(knee_point(kept), kept.size());
}

TEST(ParetoFront, FindsOptimaThatCoast) {
  ParetoProblem problem = paper_example(20, {"J1", "energy"});
  problem.maneuver.from = {0.8, 0.0};
  problem.maneuver.to = {0.8, 0.12};
  ParetoOptions options;
  options.points = 7;
  const ParetoFront front = epsilon_constraint_front(problem, options);
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  EXPECT_EQ(front.points.size(), 7U);
  expect_convex(scaled(front));
}

TEST(ParetoFront, IsOnePointWhereTheLimitsLeaveNoChoice) {
  // 11.5 m/s^2 and 3.1 rad/s are exactly what the change takes.
  ParetoProblem problem = paper_example(20, {"J1", "J2"});
  problem.maneuver.limits.acceleration_mps2 = 11.5;
  problem.maneuver.limits.steering_rate_radps = 3.1;
  const ParetoFront front = epsilon_constraint_front(problem);
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  EXPECT_EQ(front.points.size(), 1U);
  EXPECT_EQ(weighted_sum_front(problem).points.size(), 1U);
}

TEST(ParetoFront, SaysWhyThereIsNone) {
  ParetoProblem problem = paper_example(20, {"J1", "J2"});
  problem.maneuver.limits.acceleration_mps2 = 10.0;
  const ParetoFront front = epsilon_constraint_front(problem);
  EXPECT_EQ(front.status, ManeuverStatus::kInfeasible);
  EXPECT_NE(front.reason.find("needs acceleration 11.5 m/s^2"), std::string::npos) << front.reason;
  EXPECT_TRUE(front.points.empty());
}

// Stopping distances are all but flat near their optimum, and full of local optima.
TEST(ParetoFront, IsEvenAndUndominatedByWeightedSumsWhereACriterionIsFlat) {
  ParetoProblem problem = paper_example(20, {"J2", "stopping_distance"});
  std::swap(problem.maneuver.from, problem.maneuver.to);
  const ParetoFront front = epsilon_constraint_front(problem, {.points = 7});
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  const ParetoFront weighted = weighted_sum_front(problem, {.points = 7});
  const ObjectiveRange range = range_of(front.objectives());
  const Objectives noise = 1e-3 * (range.worst - range.best);
  for (const ParetoPoint& sum : weighted.points) {
    for (const ParetoPoint& point : front.points) {
      EXPECT_FALSE(dominates(sum.objectives, point.objectives, noise))
          << sum.objectives.transpose() << " dominates " << point.objectives.transpose();
    }
  }
  const std::vector<Objectives> points = scaled(front);
  for (std::size_t i = 2; i < points.size(); ++i) {
    EXPECT_NEAR((points[i] - points[i - 1]).norm(), (points[1] - points[0]).norm(), 0.1);
  }
}

// Every braking without a push needs no energy; the end is the one that drives farthest.
TEST(ParetoFront, HasAtItsEndsTheBestOfEquallyGoodManeuvers) {
  ParetoProblem problem = paper_example(20, {"J1", "energy"});
  std::swap(problem.maneuver.from, problem.maneuver.to);
  const ParetoFront front = epsilon_constraint_front(problem, {.points = 5});
  ASSERT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  ManeuverProblem least = problem.maneuver;
  least.cost_bounds = {{problem.criteria[1], 1e-4}};
  const ManeuverSolution farthest = solve(least, *problem.criteria[0]);
  ASSERT_EQ(farthest.status, ManeuverStatus::kOptimal) << farthest.reason;
  EXPECT_NEAR(front.points.front().objectives(0), farthest.cost, 0.02 * std::abs(farthest.cost));
}

TEST(ParetoFront, OfThreeCriteriaLeavesOutBoundsThatContradictEachOther) {
  ParetoProblem problem = paper_example(10, {"J2", "J1", "comfort"});
  problem.maneuver.from = {0.8, -0.24};
  problem.maneuver.to = {0.8, 0.24};
  const ParetoFront front = epsilon_constraint_front(problem, {.points = 4});
  EXPECT_EQ(front.status, ManeuverStatus::kOptimal) << front.reason;
  EXPECT_GT(front.points.size(), 3U);  // more than the optima of the single criteria
  EXPECT_LT(front.points.size(), 3U + 9U);
}

TEST(CostBound, IsKeptAndOneThatCannotBeIsNamed) {
  ManeuverProblem problem = paper_example(20, {}).maneuver;
  const auto j1 = make_criterion("J1", problem.vehicle);
  problem.cost_bounds = {{std::make_shared<Effort>(), 40.0}};
  const ManeuverSolution bounded = solve(problem, *j1);
  ASSERT_EQ(bounded.status, ManeuverStatus::kOptimal) << bounded.reason;
  EXPECT_NEAR(bounded.criteria[1].value, 40.0, 1e-6);
  EXPECT_LT(bounded.first_order_residual, 1e-4);

  problem.cost_bounds[0].max = 20.0;
  const ManeuverSolution none = solve(problem, *j1);
  EXPECT_EQ(none.status, ManeuverStatus::kInfeasible);
  EXPECT_EQ(none.reason, "a cost that is bounded by 20 is at least 28.372");
}

}  // namespace
}  // namespace hlc::maneuver_design
