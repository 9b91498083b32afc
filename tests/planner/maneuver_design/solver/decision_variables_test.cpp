#include "planner/maneuver_design/solver/decision_variables.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hlc::maneuver_design {
namespace {

using testing::Message;

ManeuverProblem problem_of(std::size_t intervals) {
  return {{0.4, -0.2}, {0.8, 0.12}, 0.2, intervals, {}, {}};
}

TEST(DecisionVariables, InputsAndVariablesAreEachOthersInverse) {
  ManeuverProblem problem = problem_of(7);
  problem.free_duration = DurationRange{0.1, 0.5};
  const DecisionVariables variables(problem, 0.2);
  ASSERT_EQ(variables.size(), 15);
  const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(15, -1.0, 1.2);
  EXPECT_EQ(variables.inputs(z)[0].acceleration_mps2, -12.0);
  EXPECT_NEAR(variables.duration_s(z), 0.24, 1e-15);
  const Eigen::VectorXd again = variables.variables(variables.inputs(z), variables.duration_s(z));
  EXPECT_LT((again - z).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_DOUBLE_EQ(variables.lower()(14), 0.5);
  EXPECT_DOUBLE_EQ(variables.upper()(14), 2.5);
}

TEST(DecisionVariables, EndConditionsAreMetWithinTheBoundsAlsoWhereMostInputsAreAtThem) {
  constexpr unsigned kSeed = 31;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    const ManeuverProblem problem = problem_of(20);
    const DecisionVariables variables(problem, problem.duration_s);
    Eigen::VectorXd z =
        Eigen::VectorXd::NullaryExpr(variables.size(), [&](Eigen::Index) { return any(random); })
            .cwiseMax(-1.0)
            .cwiseMin(1.0);
    for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
      meet_end_condition(channel, variables, z);
      EXPECT_NEAR(variables.of(channel, z).mean(),
                  variables.wanted_mean(channel, problem.duration_s), 1e-6);
    }
    EXPECT_LE(z.lpNorm<Eigen::Infinity>(), 1.0);
  }
}

TEST(DecisionVariables, ASmallErrorIsRepairedToTheLastBits) {
  const ManeuverProblem problem = problem_of(20);
  const DecisionVariables variables(problem, problem.duration_s);
  const Channel speed = speed_channel(problem);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(variables.size());
  auto values = variables.of(speed, z);
  values.head(10).setOnes();
  values.tail(10).setConstant(-1.0);
  values(10) = 20.0 * variables.wanted_mean(speed, 0.2) - 1.0 + 1e-9;
  meet_end_condition(speed, variables, z);
  EXPECT_NEAR(values.mean(), variables.wanted_mean(speed, 0.2), 1e-16);
  EXPECT_NEAR(values.head(10).minCoeff(), 1.0, 1e-9);
}

}  // namespace
}  // namespace hlc::maneuver_design
