#include "planner/controller/trajectory.hpp"

#include <gtest/gtest.h>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::controller {
namespace {

constexpr double kInterval_s = 0.05;
constexpr double kStep_s = 0.2;

const automaton::Maneuver& edge(std::size_t from, std::size_t to) {
  return *automaton::paper_automaton()->find(automaton::pi(from), automaton::pi(to),
                                             from == to ? automaton::kSelfLoopLabel : "J2");
}

coordination::Plan driving_plan() {
  return coordination::Plan({10}, {1.0, 2.0, 0.5}, edge(1, 1))
      .continued({11}, {&edge(1, 9), &edge(9, 9), &edge(9, 10), &edge(10, 1)});
}

std::vector<TimedPoint> sample(const coordination::Plan& plan, StepIndex step,
                               double until_s = 1.0) {
  return sample_trajectory(plan, step, kInterval_s, until_s, kStep_s,
                           automaton::paper_automaton()->vehicle);
}

TEST(Trajectory, TimesIncreaseFromOneIntervalBefore) {
  const auto samples = sample(driving_plan(), {12});
  ASSERT_GT(samples.size(), 3U);
  EXPECT_DOUBLE_EQ(samples.front().time_s, -kInterval_s);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].time_s - samples[i - 1].time_s, kInterval_s, 1e-12);
  }
  EXPECT_GE(samples.back().time_s, 1.0);
}

TEST(Trajectory, PassesThroughThePlannedPosesAndEndsStanding) {
  const coordination::Plan plan = driving_plan();
  for (const TimedPoint& one : sample(plan, {11})) {
    const double steps = one.time_s / kStep_s;
    if (one.time_s < 0.0 || std::abs(steps - std::round(steps)) > 1e-9) continue;
    const StepIndex step{11 + static_cast<std::uint64_t>(std::lround(steps))};
    EXPECT_NEAR((one.position_m - plan.pose_at(step).position_m()).norm(), 0.0, 1e-12);
  }
  const auto samples = sample(plan, {11});
  EXPECT_EQ(samples.back().velocity_mps.norm(), 0.0);
  EXPECT_EQ(samples[samples.size() - 2].velocity_mps.norm(), 0.0);
}

TEST(Trajectory, VelocitiesAreTheDerivativesOfThePositions) {
  const coordination::Plan plan = driving_plan();
  const double small_s = 1e-5;
  for (std::uint64_t step = 11; step < 15; ++step) {
    for (const double time_s : {0.03, 0.11, 0.17}) {
      const auto at = [&](double t) {
        return plan.state_at({step}, t, automaton::paper_automaton()->vehicle).pose.position_m();
      };
      const Point numeric = (at(time_s + small_s) - at(time_s - small_s)) / (2.0 * small_s);
      const auto samples = sample_trajectory(plan, {step}, 0.01, 0.3, kStep_s,
                                             automaton::paper_automaton()->vehicle);
      const auto index = static_cast<std::size_t>(std::lround(time_s / 0.01)) + 1;
      ASSERT_NEAR(samples[index].time_s, time_s, 1e-12);
      EXPECT_NEAR((samples[index].velocity_mps - numeric).norm(), 0.0, 1e-4);
    }
  }
}

TEST(Trajectory, AStandingPlanIsHeldAsLongAsAsked) {
  const auto samples = sample(coordination::Plan({10}, {1.0, 2.0, 0.5}, edge(1, 1)), {10}, 2.0);
  EXPECT_GE(samples.back().time_s, 2.0);
  for (const TimedPoint& one : samples) {
    EXPECT_EQ(one.position_m, Point(1.0, 2.0));
    EXPECT_EQ(one.velocity_mps.norm(), 0.0);
  }
}

}  // namespace
}  // namespace hlc::controller
