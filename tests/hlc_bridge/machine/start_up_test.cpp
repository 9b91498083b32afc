#include "hlc_bridge/machine/start_up.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "hlc_bridge/messages/exit_codes.hpp"

namespace hlc::machine {
namespace {

using Action = std::variant<ParameterRequest, LogLine>;
using testing::ElementsAre;

constexpr Nanoseconds kTimeout = 30 * kNanosecondsPerSecond;
constexpr Nanoseconds kBegin = 500 * kNanosecondsPerSecond;

std::vector<std::string> requested(const std::vector<Action>& actions) {
  std::vector<std::string> names;
  for (const Action& action : actions) {
    if (const auto* request = std::get_if<ParameterRequest>(&action))
      names.push_back(request->name);
  }
  return names;
}

std::vector<LogLine> logged(const std::vector<Action>& actions) {
  std::vector<LogLine> lines;
  for (const Action& action : actions) {
    if (const auto* line = std::get_if<LogLine>(&action)) lines.push_back(*line);
  }
  return lines;
}

struct StartUpTest : testing::Test {
  bool learn(Nanoseconds now) {
    actions.clear();
    return start_up.learn(now, actions);
  }
  bool connect(Nanoseconds now, const std::string& missing) {
    actions.clear();
    return start_up.connect(now, missing, actions);
  }
  void publish_everything() {
    start_up.take({kPeriodParameter, std::uint64_t{200}});
    start_up.take({kActiveIdsParameter, std::vector<std::int32_t>{1, 2}});
  }

  StartUp start_up{kTimeout};
  std::vector<Action> actions;
};

TEST_F(StartUpTest, AsksForWhatIsMissingAgainAndAgain) {
  EXPECT_FALSE(learn(kBegin));
  EXPECT_THAT(requested(actions), ElementsAre(kPeriodParameter, kActiveIdsParameter));
  EXPECT_EQ(start_up.wake_up(), kBegin + StartUp::kRequestInterval);
  EXPECT_FALSE(learn(kBegin + 1)) << "not before it is time";
  EXPECT_TRUE(actions.empty());
  start_up.take({kPeriodParameter, std::uint64_t{200}});
  EXPECT_FALSE(learn(*start_up.wake_up()));
  EXPECT_THAT(requested(actions), ElementsAre(kActiveIdsParameter));
  publish_everything();
  EXPECT_TRUE(learn(kBegin + StartUp::kRequestInterval + 1));
  EXPECT_EQ(start_up.wake_up(), std::nullopt);
  EXPECT_TRUE(actions.empty());
}

TEST_F(StartUpTest, LogsForWhomItWaits) {
  std::vector<LogLine> lines;
  EXPECT_FALSE(learn(kBegin));
  while (*start_up.wake_up() < kBegin + 3 * kNanosecondsPerSecond) {
    EXPECT_FALSE(learn(*start_up.wake_up()));
    for (const LogLine& line : logged(actions)) lines.push_back(line);
  }
  EXPECT_THAT(lines, ElementsAre(info("waiting for lab_control to send middleware_period_ms, "
                                      "active_vehicle_ids")));
}

TEST_F(StartUpTest, ALabControlThatDoesNotAnswerIsMissed) {
  EXPECT_FALSE(learn(kBegin));
  EXPECT_FALSE(learn(kBegin + kTimeout - 1));
  EXPECT_EQ(start_up.exit_code(), std::nullopt);
  EXPECT_EQ(start_up.wake_up(), kBegin + kTimeout);
  EXPECT_FALSE(learn(kBegin + kTimeout));
  EXPECT_EQ(start_up.exit_code(), kExitMissing);
  EXPECT_THAT(logged(actions), ElementsAre(error("lab_control did not send middleware_period_ms, "
                                                 "active_vehicle_ids within 30 s")));
}

TEST_F(StartUpTest, WaitsForEverybodyWithinTheSameTime) {
  EXPECT_FALSE(learn(kBegin));
  publish_everything();
  EXPECT_TRUE(learn(kBegin + kTimeout - 10));
  EXPECT_FALSE(connect(kBegin + kTimeout - 10, "a, b"));
  EXPECT_THAT(logged(actions), ElementsAre(info("waiting for a, b")));
  EXPECT_EQ(start_up.wake_up(), kBegin + kTimeout);
  EXPECT_FALSE(connect(kBegin + kTimeout, "b"));
  EXPECT_THAT(logged(actions), ElementsAre(error("missing after 30 s: b")));
  EXPECT_EQ(start_up.exit_code(), kExitMissing);
}

TEST_F(StartUpTest, GoesOnWhenEverybodyIsThere) {
  publish_everything();
  EXPECT_TRUE(learn(kBegin));
  EXPECT_FALSE(connect(kBegin, "a"));
  EXPECT_EQ(start_up.wake_up(), kBegin + 2 * kNanosecondsPerSecond);
  EXPECT_TRUE(connect(kBegin + 5, ""));
  EXPECT_EQ(start_up.wake_up(), std::nullopt);
  EXPECT_EQ(start_up.exit_code(), std::nullopt);
}

}  // namespace
}  // namespace hlc::machine
