/// No start finds a better optimum than the solver does by itself; and every feasible pair is
/// solved, whatever the vehicle.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/friction_circle.hpp"
#include "planner/maneuver_design/solver/maneuver_solver.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;
using Uniform = std::uniform_real_distribution<double>;

/// Inputs of three kinds in turn: any, bang-bang with random switching times, steering alone.
std::vector<vehicle::Input> random_inputs(std::uint64_t kind, std::size_t size,
                                          const vehicle::VehicleLimits& limits,
                                          std::mt19937_64& random) {
  Uniform unit(-1.0, 1.0);
  std::vector<vehicle::Input> inputs(size);
  Eigen::Vector2d sign(unit(random) > 0.0 ? 1.0 : -1.0, unit(random) > 0.0 ? 1.0 : -1.0);
  for (vehicle::Input& u : inputs) {
    for (double& s : sign) {
      s = unit(random) < -0.7 ? -s : s;
    }
    const Eigen::Vector2d any(unit(random), unit(random));
    const Eigen::Vector2d share = kind % 3 == 0   ? any
                                  : kind % 3 == 1 ? sign
                                                  : Eigen::Vector2d(0.0, sign.y());
    u = {share.x() * limits.acceleration_mps2, share.y() * limits.steering_rate_radps};
  }
  return inputs;
}

TEST(MultiStart, NoRandomStartFindsAnythingBetterForAnyEdgeOfThePaper) {
  constexpr std::uint64_t kSeed = 71;
  const std::uint64_t starts = test::num_costly_seeds(10);
  SCOPED_TRACE(Message() << "seed " << kSeed);
  const AutomatonConfiguration& c = automaton::paper_configuration();
  for (const std::string criterion : {"J1", "J2", "J3"}) {
    const auto cost = make_criterion(criterion, c.vehicle);
    std::mt19937_64 random(kSeed);
    std::uint64_t found = 0;
    for (const TrimPair& edge : automaton::paper_edges()) {
      SCOPED_TRACE(Message() << criterion << ", " << edge.from.index + 1 << " -> "
                             << edge.to.index + 1);
      const ManeuverProblem problem{c.trims[edge.from.index],
                                    c.trims[edge.to.index],
                                    c.step_s,
                                    c.intervals,
                                    c.vehicle,
                                    c.limits};
      const ManeuverSolution own = solve(problem, *cost);
      ASSERT_EQ(own.status, ManeuverStatus::kOptimal) << own.reason;
      for (std::uint64_t i = 0; i < starts; ++i) {
        SolverOptions options;
        options.start = random_inputs(i, c.intervals, c.limits, random);
        const ManeuverSolution other = solve(problem, *cost, options);
        if (other.status == ManeuverStatus::kOptimal) {
          ++found;
          ASSERT_GT(other.cost, own.cost - 1e-5 * std::abs(own.cost)) << "start " << i;
        }
      }
    }
    EXPECT_GE(found, 50 * starts * 9 / 10) << criterion << ": too few starts lead anywhere";
  }
}

TEST(MultiStart, NoRandomStartStopsShorterByMuch) {
  constexpr std::uint64_t kSeed = 73;
  SCOPED_TRACE(Message() << "seed " << kSeed);
  const AutomatonConfiguration& c = automaton::paper_configuration();
  const auto cost = make_criterion("stopping_distance", c.vehicle);
  std::mt19937_64 random(kSeed);
  for (std::size_t from = 2; from <= 12; ++from) {
    SCOPED_TRACE(Message() << "from " << from);
    const ManeuverProblem problem{c.trims[from - 1], c.trims[0], c.step_s,
                                  c.intervals,       c.vehicle,  c.limits};
    const ManeuverSolution own = solve(problem, *cost);
    ASSERT_EQ(own.status, ManeuverStatus::kOptimal) << own.reason;
    for (std::uint64_t i = 0; i < test::num_seeds(6); ++i) {
      SolverOptions options;
      options.start = random_inputs(i, c.intervals, c.limits, random);
      const ManeuverSolution other = solve(problem, *cost, options);
      if (other.status == ManeuverStatus::kOptimal) {
        EXPECT_GT(other.cost, own.cost * (1.0 - 1e-3)) << "start " << i;
      }
    }
  }
}

struct Car {
  const char* name;
  vehicle::VehicleParameters vehicle;
  vehicle::VehicleLimits limits;
  double duration_s;
  double friction_mps2;  ///< 0: none
};

std::vector<Car> cars() {
  const vehicle::VehicleParameters small;
  vehicle::VehicleParameters longer = small;
  longer.wheelbase_m = 0.2;
  longer.rear_axle_to_cg_m = 0.1;
  vehicle::VehicleParameters full_size = small;
  full_size.wheelbase_m = 2.578;
  full_size.rear_axle_to_cg_m = 1.42;
  const vehicle::VehicleLimits usual;
  return {{"small", small, usual, 0.2, 0.0},
          {"longer, wide limits", longer, {20.0, 12.0, 0.0, 3.7, 0.62}, 0.2, 0.0},
          {"small, speed and steering bounds near", small, {12.0, 6.2, 0.0, 1.0, 0.61}, 0.2, 0.0},
          {"small, weak", small, {4.5, 6.2, 0.0, 3.7, 0.62}, 0.2, 0.0},
          {"small, long step", small, usual, 0.6, 0.0},
          {"small, friction circle", small, usual, 0.2, 6.0},
          {"full-size", full_size, {8.0, 0.4, 0.0, 30.0, 0.91}, 0.5, 0.0},
          {"full-size, friction circle", full_size, {8.0, 0.4, 0.0, 30.0, 0.91}, 0.5, 7.0}};
}

/// A speed up to the bound, at speeds of a road with little steering; now and then exactly 0.
automaton::Trim random_trim(const vehicle::VehicleLimits& limits, std::mt19937_64& random) {
  Uniform share(0.0, 1.0);
  automaton::Trim trim{share(random) * limits.speed_max_mps,
                       (2.0 * share(random) - 1.0) * limits.steering_max_rad};
  trim.steering_rad *= trim.speed_mps > 10.0 ? 0.05 : 1.0;
  if (share(random) < 0.15) trim.speed_mps = 0.0;
  if (share(random) < 0.25) trim.steering_rad = 0.0;
  return trim;
}

TEST(MultiStart, EveryFeasiblePairOfManyVehiclesIsSolved) {
  constexpr std::uint64_t kSeed = 72;
  SCOPED_TRACE(Message() << "seed " << kSeed);
  for (const Car& car : cars()) {
    std::mt19937_64 random(kSeed);
    int optimal = 0;
    for (std::uint64_t pair = 0; pair < test::num_seeds(6); ++pair) {
      ManeuverProblem problem{random_trim(car.limits, random),
                              random_trim(car.limits, random),
                              car.duration_s,
                              20,
                              car.vehicle,
                              car.limits};
      if (pair % 2 == 0) {  // near enough to be feasible
        const double most_mps = 0.9 * car.limits.acceleration_mps2 * car.duration_s;
        problem.to.speed_mps = std::clamp(problem.to.speed_mps, problem.from.speed_mps - most_mps,
                                          problem.from.speed_mps + most_mps);
        const double most_rad = 0.9 * car.limits.steering_rate_radps * car.duration_s;
        problem.to.steering_rad =
            std::clamp(problem.to.steering_rad, problem.from.steering_rad - most_rad,
                       problem.from.steering_rad + most_rad);
      }
      if (car.friction_mps2 > 0.0) {
        problem.path_constraints = {
            std::make_shared<FrictionCircle>(car.friction_mps2, car.vehicle)};
      }
      for (const std::string criterion : {"J1", "J2", "J3", "comfort", "energy"}) {
        SCOPED_TRACE(Message() << car.name << ", pair " << pair << ", " << criterion << ": "
                               << problem.from.speed_mps << ", " << problem.from.steering_rad
                               << " -> " << problem.to.speed_mps << ", "
                               << problem.to.steering_rad);
        const ManeuverSolution solution =
            solve(problem, *make_criterion(criterion, problem.vehicle));
        EXPECT_NE(solution.status, ManeuverStatus::kNotConverged) << solution.reason;
        if (solution.status == ManeuverStatus::kOptimal) {
          ++optimal;
          EXPECT_LT(solution.first_order_residual, 1e-4);
          EXPECT_LT(solution.residuals.path, 1e-8);
        }
      }
    }
    EXPECT_GE(optimal, 10) << car.name;
  }
}

TEST(MultiStart, TheTieBreakCostsNothingThatMatters) {
  for (const auto& [from, to] : {std::pair{7U, 8U}, std::pair{12U, 11U}, std::pair{1U, 12U}}) {
    const AutomatonConfiguration& c = automaton::paper_configuration();
    const ManeuverProblem problem{c.trims[from - 1], c.trims[to - 1], c.step_s,
                                  c.intervals,       c.vehicle,       c.limits};
    const auto cost = make_criterion("J1", c.vehicle);
    SolverOptions none;
    none.tie_break = 0.0;
    const double best = solve(problem, *cost, none).cost;
    EXPECT_LT(solve(problem, *cost).cost, best + 1e-7 * std::abs(best));
  }
}

}  // namespace
}  // namespace hlc::maneuver_design
