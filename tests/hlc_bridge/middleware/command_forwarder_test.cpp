#include "hlc_bridge/middleware/command_forwarder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/middleware/middleware_in_memory.hpp"

namespace hlc::middleware {
namespace {

using test::command;
using test::kMs;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanoseconds kList = 400 * kMs + kListOffset;

struct Outcome {
  std::size_t forwarded{};
  std::vector<std::string> lines;
};

class CommandForwarderTest : public testing::Test {
 protected:
  Outcome receive(VehicleCommand any, bool is_withheld = false) {
    MiddlewareActions actions;
    forwarder_.receive(std::move(any), kList, kList, is_withheld, actions);
    Outcome outcome;
    for (const MiddlewareAction& action : actions) {
      if (std::holds_alternative<VehicleCommand>(action)) ++outcome.forwarded;
      if (const auto* line = std::get_if<machine::LogLine>(&action)) {
        outcome.lines.push_back(line->text);
      }
    }
    return outcome;
  }

  CommandForwarder forwarder_{{1, 2}};
};

TEST_F(CommandForwarderTest, ForwardsCommandsOfAllKindsWithoutALine) {
  for (const VehicleCommand& any : std::vector<VehicleCommand>{
           command(1, kList), PathTrackingCommand{.vehicle_id = 1, .create_stamp = kList},
           SpeedCurvatureCommand{.vehicle_id = 2, .create_stamp = kList},
           DirectCommand{.vehicle_id = 2, .create_stamp = kList}}) {
    const Outcome outcome = receive(any);
    EXPECT_EQ(outcome.forwarded, 1U);
    EXPECT_THAT(outcome.lines, IsEmpty());
  }
}

TEST_F(CommandForwarderTest, KeepsBackCommandsOfOtherVehicles) {
  EXPECT_EQ(receive(command(3, kList)).forwarded, 0U);
  EXPECT_EQ(receive(DirectCommand{.vehicle_id = 3, .create_stamp = kList}).forwarded, 0U);
  EXPECT_THAT(forwarder_.unanswered(kList), ElementsAre(1, 2));
}

TEST_F(CommandForwarderTest, LogsAFaultOfEachKindOnce) {
  EXPECT_THAT(receive(command(1, kList - test::kPeriod)).lines,
              ElementsAre("command of high_level_controller_1: missed the current period "
                          "(logged once)"));
  EXPECT_THAT(receive(command(2, kList - test::kPeriod)).lines, IsEmpty());
  EXPECT_THAT(receive(command(1, kList + 1)).lines,
              ElementsAre("command of high_level_controller_1: create_stamp lies in the future "
                          "(logged once)"));
  EXPECT_THAT(receive(command(3, kList)).lines,
              ElementsAre("command of high_level_controller_3: vehicle is not assigned to this "
                          "middleware; not forwarded (logged once)"));
}

TEST_F(CommandForwarderTest, ForwardsStaleAndEarlyCommands) {
  EXPECT_EQ(receive(command(1, kList - test::kPeriod)).forwarded, 1U);
  EXPECT_EQ(receive(command(1, kList + 1)).forwarded, 1U);
}

TEST_F(CommandForwarderTest, AnswersCountThoughTheyAreNotForwarded) {
  EXPECT_EQ(receive(command(1, kList), true).forwarded, 0U);
  EXPECT_THAT(forwarder_.unanswered(kList), ElementsAre(2));
  TrajectoryCommand undrivable = command(2, kList);
  undrivable.points[1].t = undrivable.points[0].t;
  EXPECT_EQ(receive(undrivable).forwarded, 0U);
  EXPECT_THAT(forwarder_.unanswered(kList), IsEmpty());
  receive(command(2, kList - test::kPeriod));  // an older one takes nothing back
  EXPECT_THAT(forwarder_.unanswered(kList), IsEmpty());
  EXPECT_THAT(forwarder_.unanswered(kList + 1), ElementsAre(1, 2));
}

TEST_F(CommandForwarderTest, CountsMissedAnswersAndLogsTheFirst) {
  receive(command(1, kList));
  MiddlewareActions actions;
  forwarder_.count_missed_answers(kList, actions);
  forwarder_.count_missed_answers(kList + 1, actions);
  EXPECT_EQ(forwarder_.missed_answers(), 3U);
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(
      std::get<machine::LogLine>(actions[0]),
      machine::warning("no answer of high_level_controller_2 to a state list in time; its log may "
                       "state why (logged once)"));
}

}  // namespace
}  // namespace hlc::middleware
