#include "hlc_bridge/hlc/command.hpp"

#include <gtest/gtest.h>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::high_level_controller::command_test {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr StepIndex kStep{50};
constexpr Nanoseconds kNow = 50 * kPeriod + 1;

const automaton::Maneuver& edge(std::size_t from, std::size_t to) {
  return *automaton::paper_automaton()->find(automaton::pi(from), automaton::pi(to),
                                             from == to ? automaton::kSelfLoopLabel : "J2");
}

TrajectoryCommand driving_command() {
  std::vector<const automaton::Maneuver*> eight{&edge(1, 7)};
  for (int i = 0; i < 6; ++i) eight.push_back(&edge(7, 7));
  eight.push_back(&edge(7, 1));
  const coordination::Plan plan =
      coordination::Plan(kStep, {1.0, 2.0, 0.5}, edge(1, 1)).continued({51}, eight);
  return command_of({7}, &plan, kStep, kNow, kPeriod, automaton::paper_automaton()->vehicle);
}

TEST(Command, AnswersTheListAndIsValidAtOnce) {
  const TrajectoryCommand command = driving_command();
  EXPECT_EQ(command.vehicle_id, 7);
  EXPECT_EQ(command.create_stamp, kNow);
  EXPECT_EQ(command.valid_after_stamp, kNow);
}

TEST(Command, HasPointsBeforeAndAfterItIsValidWithStrictlyIncreasingTimes) {
  const TrajectoryCommand command = driving_command();
  EXPECT_LT(command.points.front().t, command.valid_after_stamp);
  for (std::size_t i = 1; i < command.points.size(); ++i) {
    EXPECT_LT(command.points[i - 1].t, command.points[i].t);
  }
}

// The lab's vehicle brakes in every tick in which a command does not reach 360 ms into the future.
TEST(Command, ReachesBeyondTheLookAheadAsLongAsACopyIsUsable) {
  const TrajectoryCommand command = driving_command();
  const TrajectoryCommand copy = copy_for_later(command);
  EXPECT_EQ(copy.create_stamp, command.create_stamp);
  EXPECT_LT(copy.valid_after_stamp, command.valid_after_stamp + kCommandLifetime)
      << "no gap between the two";
  const Nanoseconds usable_until = copy.valid_after_stamp + kCommandLifetime;
  const Nanoseconds plan_end = (kStep.value + 9) * kPeriod;
  EXPECT_GE(usable_until, plan_end) << "the whole plan can be driven without a controller";
  EXPECT_GE(command.points.back().t, usable_until + 360'000'000);
  EXPECT_EQ(command.points.back().vx_mps, 0.0);
  EXPECT_EQ(command.points.back().vy_mps, 0.0);
}

TEST(Command, OfALongPlanHasCopiesOneAfterTheOtherUntilThePlanHasEnded) {
  constexpr std::size_t kCopies = 5;
  std::vector<const automaton::Maneuver*> maneuvers{&edge(1, 7)};
  for (int i = 0; i < 20; ++i) maneuvers.push_back(&edge(7, 7));
  maneuvers.push_back(&edge(7, 1));
  const coordination::Plan plan =
      coordination::Plan(kStep, {1.0, 2.0, 0.5}, edge(1, 1)).continued({51}, maneuvers);
  const TrajectoryCommand command =
      command_of({7}, &plan, kStep, kNow, kPeriod, automaton::paper_automaton()->vehicle,
                 controller::kPointInterval_s, kCopies);
  for (std::size_t number = 1; number <= kCopies; ++number) {
    EXPECT_EQ(copy_for_later(command, number).valid_after_stamp, kNow + number * kCopyDelay);
  }
  const Nanoseconds usable_until =
      copy_for_later(command, kCopies).valid_after_stamp + kCommandLifetime;
  EXPECT_EQ(usable_until, kNow + followed_ns(kCopies));
  EXPECT_GE(usable_until, (kStep.value + 23) * kPeriod) << "the whole plan";
  EXPECT_GE(command.points.back().t, usable_until + kLookAhead);
  const TrajectoryCommand none =
      command_of({7}, nullptr, kStep, kNow, kPeriod, automaton::paper_automaton()->vehicle,
                 controller::kPointInterval_s, kCopies);
  EXPECT_GE(none.valid_after_stamp, usable_until) << "it takes no copy away from the vehicle";
}

TEST(Command, WithoutAPlanTakesNoFormerCommandAwayFromTheVehicle) {
  const TrajectoryCommand command =
      command_of({7}, nullptr, kStep, kNow, kPeriod, automaton::paper_automaton()->vehicle);
  EXPECT_TRUE(command.points.empty());
  EXPECT_EQ(command.create_stamp, kNow) << "it answers the list";
  const coordination::Plan plan({kStep}, {1.0, 2.0, 0.5}, edge(1, 1));
  const TrajectoryCommand former = copy_for_later(
      command_of({7}, &plan, kStep, kNow, kPeriod, automaton::paper_automaton()->vehicle));
  EXPECT_GE(command.valid_after_stamp, former.valid_after_stamp + kCommandLifetime);
}

TEST(Command, AtTheBeginOfLogicalTimeNoPointLiesBeforeZero) {
  const coordination::Plan plan({0}, {1.0, 2.0, 0.5}, edge(1, 1));
  const TrajectoryCommand command =
      command_of({7}, &plan, {0}, 1, kPeriod, automaton::paper_automaton()->vehicle);
  EXPECT_EQ(command.points.front().t, 0U);
}

}  // namespace
}  // namespace hlc::high_level_controller::command_test
