#include "planner/maneuver_design/solver/starting_point.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "planner/maneuver_design/distance.hpp"
#include "planner/maneuver_design/feasibility.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/stopping_distance.hpp"

namespace hlc::maneuver_design {
namespace {

using testing::Message;

ConstraintResiduals residuals(const ManeuverProblem& problem,
                              const std::vector<vehicle::Input>& inputs) {
  const Shot shot = shoot(start_state(problem), inputs, problem.duration_s, Distance{},
                          problem.vehicle, WithGradient::kNo);
  return residuals_of(problem, inputs, shot.states, problem.duration_s);
}

TEST(StartingPoint, AllCoursesConnectTheTrimsWithinAllBounds) {
  // Bounds on the states that full input would leave; odd and even numbers of intervals.
  for (const std::size_t intervals : {1U, 2U, 7U, 20U}) {
    ManeuverProblem problem{{0.9, 0.55}, {0.2, -0.3}, 0.2, intervals, {}, {}};
    problem.limits.speed_max_mps = 1.0;
    problem.limits.speed_min_mps = 0.1;
    const StoppingDistance cost;
    const Transcription transcription(problem, cost, problem.duration_s, 0.0);
    const std::vector<Eigen::VectorXd> starts = starting_points(transcription, {});
    EXPECT_EQ(starts.size(), 15U);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      SCOPED_TRACE(Message() << intervals << " intervals, course " << i);
      EXPECT_TRUE(within_tolerance(residuals(problem, transcription.variables().inputs(starts[i])),
                                   problem.limits));
    }
  }
}

TEST(StartingPoint, ForDistanceItIsFullAccelerationUpToTheBoundAndLateBraking) {
  ManeuverProblem problem{{0.8, 0.0}, {0.8, 0.0}, 0.2, 20, {}, {}};
  problem.limits.speed_max_mps = 1.4;
  const Distance cost;
  const Transcription transcription(problem, cost, problem.duration_s, 0.0);
  const std::vector<Eigen::VectorXd> starts = starting_points(transcription, {});
  ASSERT_EQ(starts.size(), 1U);
  for (Eigen::Index k = 0; k < 20; ++k) {
    EXPECT_NEAR(starts[0](2 * k), k < 5 ? 1.0 : k < 15 ? 0.0 : -1.0, 1e-12) << k;
    EXPECT_EQ(starts[0](2 * k + 1), 0.0);
  }
}

TEST(StartingPoint, InputsOnAnotherNumberOfIntervalsKeepTheirMeanOverEveryTime) {
  std::vector<vehicle::Input> inputs(6);
  for (std::size_t k = 0; k < 6; ++k) {
    inputs[k] = {static_cast<double>(k), -2.0 * static_cast<double>(k)};
  }
  const std::vector<vehicle::Input> fine = resampled(inputs, 12);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_NEAR(fine[k].acceleration_mps2, inputs[k / 2].acceleration_mps2, 1e-15);
  }
  const std::vector<vehicle::Input> other = resampled(inputs, 4);
  ASSERT_EQ(other.size(), 4U);
  EXPECT_NEAR(other[0].acceleration_mps2, (0.0 + 0.5 * 1.0) / 1.5, 1e-15);
  EXPECT_NEAR(other[1].steering_rate_radps, -2.0 * (0.5 * 1.0 + 2.0) / 1.5, 1e-15);
  EXPECT_NEAR(other[3].acceleration_mps2, (0.5 * 4.0 + 5.0) / 1.5, 1e-15);
}

}  // namespace
}  // namespace hlc::maneuver_design
