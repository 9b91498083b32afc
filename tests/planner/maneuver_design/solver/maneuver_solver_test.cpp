#include "planner/maneuver_design/solver/maneuver_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/maneuver_design/distance.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

ManeuverProblem paper_problem(TrimId from, TrimId to) {
  const auto& c = automaton::paper_configuration();
  return {c.trims[from.index], c.trims[to.index], c.step_s, c.intervals, c.vehicle, c.limits};
}

/// As in the reference values: L = 0.2 m.
ManeuverProblem reference_problem(std::size_t from, std::size_t to) {
  ManeuverProblem problem = paper_problem(automaton::pi(from), automaton::pi(to));
  problem.vehicle.wheelbase_m = 0.2;
  problem.vehicle.rear_axle_to_cg_m = 0.1;
  return problem;
}

void expect_no_residuals(const ConstraintResiduals& r) {
  EXPECT_LT(r.end_speed_mps, 1e-12);
  EXPECT_LT(r.end_steering_rad, 1e-12);
  EXPECT_EQ(r.acceleration_mps2, 0.0);
  EXPECT_EQ(r.steering_rate_radps, 0.0);
  EXPECT_LT(r.speed_mps, 1e-9);
  EXPECT_LT(r.steering_rad, 1e-9);
}

TEST(ManeuverSolver, FindsTheClosedFormOfJ2ForAllPairsOfTrimsFromBothGuesses) {
  const Effort effort;
  for (std::size_t from = 1; from <= 12; ++from) {
    for (std::size_t to = 1; to <= 12; ++to) {
      if (from == to) {
        continue;
      }
      SCOPED_TRACE(Message() << from << " -> " << to);
      const ManeuverProblem problem = paper_problem(automaton::pi(from), automaton::pi(to));
      const double dv = problem.to.speed_mps - problem.from.speed_mps;
      const double ddelta = problem.to.steering_rad - problem.from.steering_rad;
      const double T = problem.duration_s;
      const double closed_form = T * (dv * dv + ddelta * ddelta) / (T * T);
      for (const Guess guess : {Guess::kConstant, Guess::kBangBang}) {
        SolverOptions options;
        options.guess = guess;
        const ManeuverSolution solution = solve(problem, effort, options);
        ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
        EXPECT_NEAR(solution.cost, closed_form, 1e-9 * closed_form);
        expect_no_residuals(solution.residuals);
      }
    }
  }
}

TEST(ManeuverSolver, ReachesTheReferenceEndPosesOfJ2) {
  const Effort effort;
  struct Reference {
    std::size_t from, to;
    double cost, dx, dy, dpsi;
  };
  for (const Reference& r :
       {Reference{7, 8, 0.0720, .1598, .0074, .0481},
        Reference{11, 12, 0.1220, .0820, .0360, .2574},
        Reference{1, 12, 2.600, .0386, .0096, .0837}, Reference{1, 7, 3.200, .0800, 0.0, 0.0},
        Reference{7, 1, 3.200, .0800, 0.0, 0.0}}) {
    SCOPED_TRACE(Message() << r.from << " -> " << r.to);
    const ManeuverSolution solution = solve(reference_problem(r.from, r.to), effort);
    ASSERT_EQ(solution.status, ManeuverStatus::kOptimal);
    EXPECT_NEAR(solution.cost, r.cost, 5e-5);
    const Pose& end = solution.states.back().pose;
    EXPECT_NEAR(end.x_m, r.dx, 6e-5);
    EXPECT_NEAR(end.y_m, r.dy, 6e-5);
    EXPECT_NEAR(end.heading_rad, r.dpsi, 6e-5);
  }
}

TEST(ManeuverSolver, ReachesTheReferenceValuesOfACostFarFromConvex) {
  const Distance distance;
  SolverOptions options;
  options.guess = Guess::kBangBang;
  struct Reference {
    std::size_t from, to;
    double cost;
  };
  for (const Reference& r :
       {Reference{7, 8, -5.531e-3}, Reference{11, 12, -3.267e-3}, Reference{1, 12, -1.515e-3},
        Reference{1, 7, -1.861e-3}, Reference{7, 1, -3.299e-3}}) {
    SCOPED_TRACE(Message() << r.from << " -> " << r.to);
    const ManeuverSolution solution = solve(reference_problem(r.from, r.to), distance, options);
    ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
    // The reference has 100 intervals; 20 cost at most 0.4 %.
    EXPECT_NEAR(solution.cost, r.cost, 4e-3 * std::abs(r.cost));
    expect_no_residuals(solution.residuals);
  }
}

TEST(ManeuverSolver, KeepsBoundsOnStatesThatTheFreeOptimumViolates) {
  const Distance distance;
  SolverOptions options;
  options.guess = Guess::kBangBang;
  ManeuverProblem problem = paper_problem(automaton::pi(7), automaton::pi(8));
  const auto fastest = [](const ManeuverSolution& solution) {
    double speed = 0.0;
    for (const vehicle::State& state : solution.states) {
      speed = std::max(speed, state.speed_mps);
    }
    return speed;
  };
  const ManeuverSolution free = solve(problem, distance, options);
  ASSERT_EQ(free.status, ManeuverStatus::kOptimal) << free.reason;
  EXPECT_GT(fastest(free), 1.5);
  problem.limits.speed_max_mps = 1.2;
  const ManeuverSolution bounded = solve(problem, distance, options);
  ASSERT_EQ(bounded.status, ManeuverStatus::kOptimal) << bounded.reason;
  EXPECT_NEAR(fastest(bounded), 1.2, 1e-8);
  EXPECT_GT(bounded.cost, free.cost);
  expect_no_residuals(bounded.residuals);
}

/// Stays near the start: brakes as hard as it may.
class NearnessCost final : public RunningCost {
 public:
  [[nodiscard]] double value(const vehicle::StateVector& x,
                             const vehicle::Input& u) const override {
    return -distance_.value(x, u);
  }
  [[nodiscard]] CostGradient gradient(const vehicle::StateVector& x,
                                      const vehicle::Input& u) const override {
    CostGradient gradient = distance_.gradient(x, u);
    gradient.state *= -1.0;
    return gradient;
  }

 private:
  Distance distance_;
};

TEST(ManeuverSolver, KeepsTheLowerBoundOnTheSpeedAndBothBoundsOnSteering) {
  ManeuverProblem problem = paper_problem(automaton::pi(7), automaton::pi(8));
  problem.limits.speed_min_mps = 0.3;
  problem.limits.steering_max_rad = 0.2;
  const ManeuverSolution slow = solve(problem, NearnessCost{});
  ASSERT_EQ(slow.status, ManeuverStatus::kOptimal) << slow.reason;
  expect_no_residuals(slow.residuals);
  double slowest = problem.from.speed_mps;
  for (const vehicle::State& state : slow.states) {
    slowest = std::min(slowest, state.speed_mps);
  }
  EXPECT_NEAR(slowest, 0.3, 1e-8);

  // The guess leaves the bounds on steering, near the left one and near the right one.
  for (const double sign : {-1.0, 1.0}) {
    problem.from.steering_rad = sign * 0.15;
    problem.to.steering_rad = sign * 0.15;
    SolverOptions options;
    options.guess = Guess::kBangBang;
    const ManeuverSolution turning = solve(problem, Distance{}, options);
    ASSERT_EQ(turning.status, ManeuverStatus::kOptimal) << turning.reason;
    expect_no_residuals(turning.residuals);
  }
}

TEST(ManeuverSolver, NamesTheBoundThatMakesAPairInfeasibleAndTheShortestDuration) {
  const Effort effort;
  ManeuverProblem problem = paper_problem(automaton::pi(1), automaton::pi(7));
  problem.to = {2.3, 0.62};
  problem.limits.acceleration_mps2 = 10.0;
  ManeuverSolution solution = solve(problem, effort);
  EXPECT_EQ(solution.status, ManeuverStatus::kInfeasible);
  EXPECT_NEAR(solution.shortest_duration_s, 0.23, 1e-12);
  EXPECT_EQ(
      solution.reason,
      "speed 0 -> 2.3 m/s in 0.2 s needs acceleration 11.5 m/s^2, must be <= 10 m/s^2; shortest "
      "feasible duration 0.23 s");
  EXPECT_TRUE(solution.inputs.empty());

  problem.duration_s = 0.24;
  EXPECT_EQ(solve(problem, effort).status, ManeuverStatus::kOptimal);

  problem.limits.steering_rate_radps = 2.0;
  solution = solve(problem, effort);
  EXPECT_EQ(solution.status, ManeuverStatus::kInfeasible);
  EXPECT_NEAR(solution.shortest_duration_s, 0.31, 1e-12);
  EXPECT_NE(solution.reason.find("needs steering rate 2.58333 rad/s, must be <= 2 rad/s"),
            std::string::npos);

  problem.to.speed_mps = 4.0;
  solution = solve(problem, effort);
  EXPECT_NE(solution.reason.find("speed of a trim = 4 m/s, must be in 0 ... 3.7 m/s"),
            std::string::npos);
  EXPECT_TRUE(std::isinf(solution.shortest_duration_s));
}

TEST(ManeuverSolver, SolvesAPairThatIsJustFeasible) {
  ManeuverProblem problem = paper_problem(automaton::pi(1), automaton::pi(7));
  problem.to = {2.3, 0.62};
  problem.limits.acceleration_mps2 = 11.5;
  problem.limits.steering_rate_radps = 3.1;
  const ManeuverSolution solution = solve(problem, Effort{});
  ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
  EXPECT_NEAR(solution.inputs.front().acceleration_mps2, 11.5, 1e-9);
  EXPECT_NEAR(solution.inputs.back().steering_rate_radps, 3.1, 1e-9);
}

TEST(ManeuverSolver, SaysSoWhenItDoesNotConverge) {
  SolverOptions options;
  options.guess = Guess::kBangBang;
  options.max_evaluations = 3;
  const ManeuverSolution solution =
      solve(paper_problem(automaton::pi(7), automaton::pi(8)), Distance{}, options);
  EXPECT_EQ(solution.status, ManeuverStatus::kNotConverged);
  EXPECT_EQ(solution.reason, "not converged after 3 evaluations");
}

TEST(ManeuverSolver, MirroredTrimsHaveMirroredManeuvers) {
  const Effort effort;
  for (const auto& [from, to] : {std::pair{8U, 9U}, std::pair{1U, 12U}, std::pair{12U, 1U}}) {
    ManeuverProblem problem = paper_problem(automaton::pi(from), automaton::pi(to));
    const ManeuverSolution left = solve(problem, effort);
    problem.from.steering_rad *= -1.0;
    problem.to.steering_rad *= -1.0;
    const ManeuverSolution right = solve(problem, effort);
    ASSERT_EQ(left.states.size(), right.states.size());
    for (std::size_t k = 0; k < left.states.size(); ++k) {
      const vehicle::State& l = left.states[k];
      const vehicle::State& r = right.states[k];
      EXPECT_NEAR(l.pose.x_m, r.pose.x_m, 1e-12);
      EXPECT_NEAR(l.pose.y_m, -r.pose.y_m, 1e-12);
      EXPECT_NEAR(l.pose.heading_rad, -r.pose.heading_rad, 1e-12);
      EXPECT_NEAR(l.speed_mps, r.speed_mps, 1e-12);
      EXPECT_NEAR(l.steering_rad, -r.steering_rad, 1e-12);
    }
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
