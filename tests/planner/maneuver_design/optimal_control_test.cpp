/// The optimal control problem with all its parts: every criterion, free duration, constraints g.

#include <gtest/gtest.h>

#include <cmath>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/effort.hpp"
#include "planner/maneuver_design/friction_circle.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/solver/maneuver_solver.hpp"
#include "planner/maneuver_design/travel_time.hpp"
#include "planner/maneuver_design/weighted_sum.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

ManeuverProblem problem_between(const automaton::Trim& from, const automaton::Trim& to) {
  const auto& c = automaton::paper_configuration();
  return {from, to, c.step_s, 20, c.vehicle, c.limits, std::nullopt, {}};
}

ManeuverProblem paper_problem(std::size_t from, std::size_t to) {
  const auto& c = automaton::paper_configuration();
  return problem_between(c.trims[from - 1], c.trims[to - 1]);
}

ManeuverSolution solved(const ManeuverProblem& problem, const std::string& criterion) {
  return solve(problem, *make_criterion(criterion, problem.vehicle));
}

TEST(OptimalControl, EqualsAnInteriorPointSolutionOfMultipleShootingWithTheSameIntervals) {
  // Computed with another formulation (states are variables) and another kind of solver; L = 0.2 m.
  struct Reference {
    std::size_t from, to, intervals;
    std::string criterion;
    double cost, tolerance;
  };
  for (const Reference& r : {Reference{7, 8, 20, "J1", -5.5306407250e-03, 1e-5},
                             Reference{11, 12, 20, "J1", -3.2567324966e-03, 1e-5},
                             Reference{1, 12, 20, "J1", -1.5092621864e-03, 1e-5},
                             Reference{1, 7, 20, "J1", -1.8562315999e-03, 1e-5},
                             Reference{7, 1, 20, "J1", -3.2887777332e-03, 1e-5},
                             Reference{1, 7, 100, "J1", -1.8613154615e-03, 1e-5},
                             Reference{7, 8, 20, "J3", 3.5147058341e-02, 1e-7},
                             Reference{11, 12, 20, "J3", 6.0716182606e-02, 1e-7},
                             Reference{1, 12, 20, "J3", 1.2999682078e+00, 1e-7},
                             Reference{1, 7, 20, "J3", 1.5998719936e+00, 1e-7},
                             Reference{7, 1, 20, "J3", 1.5996586498e+00, 1e-7},
                             Reference{7, 8, 100, "J3", 3.5147058235e-02, 1e-7},
                             Reference{11, 12, 100, "J3", 6.0716182582e-02, 1e-7}}) {
    SCOPED_TRACE(Message() << r.criterion << ", " << r.from << " -> " << r.to);
    ManeuverProblem problem = paper_problem(r.from, r.to);
    problem.vehicle.wheelbase_m = 0.2;
    problem.vehicle.rear_axle_to_cg_m = 0.1;
    problem.intervals = r.intervals;
    const ManeuverSolution solution = solved(problem, r.criterion);
    ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
    EXPECT_NEAR(solution.cost, r.cost, r.tolerance * std::abs(r.cost));
  }
}

TEST(OptimalControl, ReachesTheEndPointsOfThePapersParetoFront) {
  // The paper's Fig. 1, with wider limits and L = 0.2 m. Along the flat optimum of J1 its J2
  // repeats less well than J1 does.
  ManeuverProblem problem = problem_between({0.0, 0.0}, {2.3, 0.62});
  problem.vehicle.wheelbase_m = 0.2;
  problem.vehicle.rear_axle_to_cg_m = 0.1;
  problem.limits.acceleration_mps2 = 20.0;
  problem.limits.steering_rate_radps = 12.0;
  problem.intervals = 50;
  const ManeuverSolution soft = solved(problem, "J2");
  ASSERT_EQ(soft.status, ManeuverStatus::kOptimal) << soft.reason;
  EXPECT_NEAR(soft.criteria[0].value, -2.059e-3, 1e-3 * 2.059e-3);
  EXPECT_NEAR(soft.criteria[1].value, 28.37, 1e-3 * 28.37);
  const ManeuverSolution far = solved(problem, "J1");
  ASSERT_EQ(far.status, ManeuverStatus::kOptimal) << far.reason;
  EXPECT_NEAR(far.criteria[0].value, -6.012e-3, 1e-3 * 6.012e-3);
  EXPECT_NEAR(far.criteria[1].value, 90.81, 1e-3 * 90.81);
}

TEST(OptimalControl, FirstOrderConditionsHoldForAllEdgesOfThePapersCriteria) {
  ASSERT_EQ(automaton::paper_edges().size(), 50U);
  for (const std::string criterion : {"J1", "J2", "J3"}) {
    for (const TrimPair& edge : automaton::paper_edges()) {
      SCOPED_TRACE(Message() << criterion << ", " << edge.from.index + 1 << " -> "
                             << edge.to.index + 1);
      const ManeuverSolution solution =
          solved(paper_problem(edge.from.index + 1, edge.to.index + 1), criterion);
      ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
      EXPECT_LT(solution.first_order_residual, 1e-5);
    }
  }
}

TEST(OptimalControl, FirstOrderResidualTellsAPointThatIsNoOptimum) {
  SolverOptions options;
  options.max_evaluations = 3;
  const ManeuverSolution stopped =
      solve(paper_problem(4, 5), *make_criterion("J1", vehicle::VehicleParameters{}), options);
  EXPECT_EQ(stopped.status, ManeuverStatus::kNotConverged);
  EXPECT_GT(stopped.first_order_residual, 1e-3);
}

TEST(OptimalControl, EverySolutionCarriesTheValuesOfAllCriteria) {
  const ManeuverProblem problem = paper_problem(1, 8);
  const ManeuverSolution solution = solved(problem, "comfort");
  ASSERT_EQ(solution.criteria.size(), criterion_names().size());
  for (std::size_t i = 0; i < solution.criteria.size(); ++i) {
    const CriterionValue& criterion = solution.criteria[i];
    SCOPED_TRACE(criterion.name);
    EXPECT_EQ(criterion.name, criterion_names()[i]);
    const Shot shot =
        shoot({}, solution.inputs, problem.duration_s,
              *make_criterion(criterion.name, problem.vehicle), problem.vehicle, WithGradient::kNo);
    EXPECT_EQ(criterion.value, shot.cost);
    if (criterion.name == "comfort") {
      EXPECT_EQ(criterion.value, solution.cost);
    }
  }
}

TEST(OptimalControl, EachCriterionIsLeastForItsOwnOptimum) {
  const ManeuverProblem problem = paper_problem(5, 1);
  for (std::size_t own = 0; own < criterion_names().size(); ++own) {
    SCOPED_TRACE(criterion_names()[own]);
    const ManeuverSolution best = solved(problem, criterion_names()[own]);
    ASSERT_EQ(best.status, ManeuverStatus::kOptimal) << best.reason;
    for (const char* const other : {"J1", "J2", "comfort"}) {
      const double value = solved(problem, other).criteria[own].value;
      EXPECT_LE(best.cost, value + 1e-7 * std::abs(value));
    }
  }
}

TEST(OptimalControl, MirroredTrimsHaveMirroredManeuversForEveryCriterion) {
  for (const auto& [from, to] : {std::pair{8U, 9U}, std::pair{1U, 12U}}) {
    for (const std::string criterion : {"J1", "J3", "comfort"}) {
      SCOPED_TRACE(Message() << criterion << ", " << from << " -> " << to);
      ManeuverProblem problem = paper_problem(from, to);
      const ManeuverSolution left = solved(problem, criterion);
      problem.from.steering_rad *= -1.0;
      problem.to.steering_rad *= -1.0;
      const ManeuverSolution right = solved(problem, criterion);
      EXPECT_NEAR(left.cost, right.cost, 1e-12 * std::abs(left.cost));
      constexpr double tolerance = 1e-9;
      for (std::size_t k = 0; k < left.states.size(); ++k) {
        const vehicle::State& l = left.states[k];
        const vehicle::State& r = right.states[k];
        EXPECT_NEAR(l.pose.x_m, r.pose.x_m, tolerance);
        EXPECT_NEAR(l.pose.y_m, -r.pose.y_m, tolerance);
        EXPECT_NEAR(l.speed_mps, r.speed_mps, tolerance);
      }
    }
  }
}

TEST(OptimalControl, AFreeDurationTradesEffortForTime) {
  // min over T of S / T + w T: T = sqrt(S / w), J = 2 sqrt(S w), with S = dv^2 + ddelta^2.
  ManeuverProblem problem = problem_between({0.0, 0.0}, {2.3, 0.62});
  problem.free_duration = DurationRange{0.05, 5.0};
  const double S = 2.3 * 2.3 + 0.62 * 0.62;
  for (const double w : {1.0, 10.0, 100.0}) {
    SCOPED_TRACE(w);
    const WeightedSum sum({{1.0, std::make_shared<Effort>()}, {w, std::make_shared<TravelTime>()}});
    const ManeuverSolution solution = solve(problem, sum);
    ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
    EXPECT_NEAR(solution.cost, 2.0 * std::sqrt(S * w), 1e-9 * solution.cost);
    EXPECT_NEAR(solution.duration_s, std::sqrt(S / w), 1e-6);
    EXPECT_LT(solution.residuals.end_speed_mps, 1e-12);
    EXPECT_LT(solution.first_order_residual, 1e-5);
  }
}

TEST(OptimalControl, TheShortestFreeDurationIsThatOfTheSlowerInputAndTheRangeIsKept) {
  ManeuverProblem problem = problem_between({0.0, 0.0}, {2.3, 0.62});
  problem.free_duration = DurationRange{0.05, 5.0};
  ManeuverSolution solution = solve(problem, TravelTime{});
  ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
  EXPECT_NEAR(solution.duration_s, 2.3 / 12.0, 1e-12);
  EXPECT_NEAR(solution.cost, 2.3 / 12.0, 1e-12);

  problem.free_duration = DurationRange{0.3, 0.5};
  EXPECT_NEAR(solve(problem, TravelTime{}).duration_s, 0.3, 1e-12);
  EXPECT_NEAR(solve(problem, Effort{}).duration_s, 0.5, 1e-12);

  problem.free_duration = DurationRange{0.1, 0.15};
  solution = solve(problem, TravelTime{});
  EXPECT_EQ(solution.status, ManeuverStatus::kInfeasible);
  EXPECT_NE(solution.reason.find("speed 0 -> 2.3 m/s in 0.15 s needs acceleration"),
            std::string::npos)
      << solution.reason;
  EXPECT_NEAR(solution.shortest_duration_s, 2.3 / 12.0, 1e-12);
}

TEST(OptimalControl, KeepsTheFrictionCircleAndPaysForIt) {
  ManeuverProblem problem = paper_problem(7, 10);
  const double free = solved(problem, "J1").cost;
  double before = free;
  for (const double bound : {9.0, 6.0, 4.0, 2.0}) {
    SCOPED_TRACE(bound);
    const auto circle = std::make_shared<FrictionCircle>(bound, problem.vehicle);
    problem.path_constraints = {circle};
    const ManeuverSolution solution = solved(problem, "J1");
    ASSERT_EQ(solution.status, ManeuverStatus::kOptimal) << solution.reason;
    EXPECT_LT(solution.residuals.path, 1e-8);
    EXPECT_LT(solution.first_order_residual, 1e-5);
    double largest = -1.0;
    for (std::size_t k = 0; k < solution.inputs.size(); ++k) {
      for (const std::size_t end : {k, k + 1}) {
        largest = std::max(
            largest, circle->value(vehicle::to_vector(solution.states[end]), solution.inputs[k]));
      }
    }
    EXPECT_NEAR(largest, 0.0, 1e-8);
    EXPECT_GT(solution.cost, before);
    before = solution.cost;
  }
}

TEST(OptimalControl, AFrictionCircleThatMakesAPairInfeasibleIsNamedWithTheShortestDuration) {
  // Straight ahead the circle is a bound on the acceleration: 0.8 / 3 s.
  ManeuverProblem problem = problem_between({0.0, 0.0}, {0.8, 0.0});
  problem.path_constraints = {std::make_shared<FrictionCircle>(3.0, problem.vehicle)};
  ManeuverSolution solution = solve(problem, Effort{});
  EXPECT_EQ(solution.status, ManeuverStatus::kInfeasible);
  EXPECT_NEAR(solution.shortest_duration_s, 0.8 / 3.0, 1e-6);
  EXPECT_EQ(solution.reason,
            "friction circle of 3 m/s^2 does not allow the change in 0.2 s; shortest feasible "
            "duration 0.266667 s");
  EXPECT_TRUE(solution.inputs.empty());
  problem.duration_s = solution.shortest_duration_s * (1.0 + 1e-6);
  EXPECT_EQ(solve(problem, Effort{}).status, ManeuverStatus::kOptimal);

  problem.to = {1.5, 0.6};
  solution = solve(problem, Effort{});
  EXPECT_EQ(solution.status, ManeuverStatus::kInfeasible);
  EXPECT_NE(solution.reason.find("trim of speed 1.5 m/s and steering 0.6 rad violates the friction "
                                 "circle of 3 m/s^2"),
            std::string::npos)
      << solution.reason;
  EXPECT_TRUE(std::isinf(solution.shortest_duration_s));
}

}  // namespace
}  // namespace hlc::maneuver_design
