#include "hlc_bridge/view/live_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Nanoseconds kBegin = 1'400'000'000;  // of sample_run

VehicleState state_at(Nanoseconds t) { return {.vehicle_id = 1, .create_stamp = t}; }

std::vector<json> of_kind(const std::string& kind, const std::string& portion) {
  std::vector<json> found;
  if (portion.empty()) return found;
  for (const json& message : json::parse(portion)) {
    if (message.at("kind") == kind) found.push_back(message);
  }
  return found;
}

/// Begin, in milliseconds, and number of the states of every stretch.
std::vector<std::pair<int, std::size_t>> stretches(const std::string& portion) {
  std::vector<std::pair<int, std::size_t>> found;
  for (const json& drive : of_kind("drive", portion)) {
    found.emplace_back(drive.at("begin_ms"), drive.at("x").size());
  }
  return found;
}

/// A run of one car that has begun.
LiveMessages begun() {
  const FinishedRun run = sample_run(1, 1);
  LiveMessages messages(before(run));
  messages.take(run.rows.front().record);
  static_cast<void>(messages.portion());
  return messages;
}

/// States of the car, so many milliseconds after the begin.
void take_states(const std::vector<Nanoseconds>& times_ms, LiveMessages& messages) {
  for (const Nanoseconds ms : times_ms) messages.take(state_at(kBegin + ms * 1'000'000));
}

/// The rows of all `steps` messages, by vehicle and step: all but the tables that they point to.
std::map<std::pair<int, int>, json> rows_of(const std::vector<std::string>& portions) {
  std::map<std::pair<int, int>, json> rows;
  for (const std::string& portion : portions) {
    for (const json& steps : of_kind("steps", portion)) {
      std::int64_t k = 0;
      std::int64_t x = 0;
      for (std::size_t i = 0; i < steps.at("k").size(); ++i) {
        k += steps.at("k")[i].get<std::int64_t>();
        x += steps.at("x")[i].get<std::int64_t>();
        const json& columns = steps.at("columns");
        rows[{steps.at("vehicle").get<int>(), static_cast<int>(k)}] = {
            x,
            columns.at("status")[i],
            steps.at("sets")[columns.at("plan")[i].get<std::size_t>()],
            columns.at("planning_s")[i],
            steps.at("sets")[columns.at("waits_for")[i].get<std::size_t>()],
            steps.at("names")[columns.at("subgraph")[i].get<std::size_t>()]};
      }
    }
  }
  return rows;
}

TEST(LiveMessages, AllPortionsTogetherAreTheStepsOfTheFinishedRun) {
  const FinishedRun run = sample_run(3, 20);
  LiveMessages messages(before(run));
  std::vector<std::string> portions;
  for (const result::StepRecord& row : run.rows) {
    messages.take(row.record);
    portions.push_back(messages.portion());
  }
  portions.push_back(messages.last_portion("over"));
  const auto rows = rows_of(portions);
  EXPECT_THAT(rows, SizeIs(60));
  EXPECT_EQ(rows, rows_of({page_messages(run)}));
}

TEST(LiveMessages, AStepIsSentAtOnceWithTheManeuversOfItsPlan) {
  const FinishedRun run = sample_run(1, 2);
  LiveMessages messages(before(run));
  messages.take(run.rows[0].record);
  const std::string portion = messages.portion();
  EXPECT_THAT(of_kind("steps", portion), SizeIs(1));
  EXPECT_THAT(of_kind("maneuvers", portion), SizeIs(1)) << "before the steps that point to it";
}

TEST(LiveMessages, LinesOfTheLogAreSentOnceAlsoBeforeTheRunBegins) {
  LiveMessages messages(before(sample_run(1, 2)));
  messages.take({{.process = "hlc_1", .text = "waits"}, {.process = "hlc_2", .text = "ready"}});
  const auto log = of_kind("log", messages.portion());
  ASSERT_THAT(log, SizeIs(1));
  EXPECT_EQ(log[0].at("lines")[1].at("text"), "ready");
  EXPECT_EQ(messages.portion(), "");
}

TEST(LiveMessages, TheRunStandsInTheFirstPortionOnly) {
  LiveMessages messages(before(sample_run(2, 1)));
  EXPECT_THAT(of_kind("run", messages.portion()), SizeIs(1));
  EXPECT_EQ(messages.portion(), "");
}

// As after a restart of a controller, whose first report is not that of the run.
TEST(LiveMessages, TheRunBeginsWithTheFirstStepOfAnyCarWhoeverIsHeardFirst) {
  const FinishedRun run = sample_run(2, 20);
  LiveMessages messages(before(run));
  messages.take(run.rows[2 * 15 + 1].record);  // car 2, step 15
  messages.take(run.rows[2 * 16 + 1].record);
  static_cast<void>(messages.portion());
  messages.take(run.rows[0].record);
  messages.take(run.rows[2].record);
  const std::string portion = messages.portion();
  const auto rows = rows_of({portion});
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.begin()->first, std::pair(1, 0));
  EXPECT_EQ(rows.rbegin()->first, std::pair(2, 16));
}

TEST(LiveMessages, ACarThatNeverReportsDoesNotHoldUpTheOthers) {
  const FinishedRun run = sample_run(2, 3);
  LiveMessages messages(before(run));
  messages.take(run.rows[0].record);
  messages.take(run.rows[2].record);
  for (int i = 0; i < LiveMessages::kPatience; ++i) {
    ASSERT_THAT(of_kind("steps", messages.portion()), IsEmpty());
  }
  EXPECT_THAT(of_kind("steps", messages.portion()), SizeIs(1));
}

TEST(LiveMessages, ReportsThatArriveTwiceOrFromOtherCarsOrBeforeTheStartAreNotSent) {
  const FinishedRun run = sample_run(1, 3);
  LiveMessages messages(before(run));
  ReportRecord standby = run.rows[0].record;
  standby.report.status = coordination::StepStatus::kStandby;
  standby.report.step.value -= 1;
  ReportRecord other = run.rows[0].record;
  other.report.vehicle = VehicleId{9};
  messages.take(standby);
  messages.take(other);
  for (const result::StepRecord& row : run.rows) {
    messages.take(row.record);
    messages.take(row.record);
  }
  messages.take(run.rows[0].record);
  const std::string portion = messages.last_portion("");
  ASSERT_THAT(of_kind("steps", portion), SizeIs(1));
  EXPECT_EQ(of_kind("steps", portion)[0].at("k"), json({0, 1, 1}));
}

TEST(LiveMessages, StatesContinueWhereThePortionBeforeEnded) {
  LiveMessages messages = begun();
  take_states({0, 20, 40}, messages);
  EXPECT_THAT(stretches(messages.portion()), ElementsAre(std::pair(0, 3)));
  messages.take(state_at(kBegin + 60'000'000));
  EXPECT_THAT(stretches(messages.portion()), ElementsAre(std::pair(40, 2)));
  EXPECT_EQ(messages.portion(), "") << "nothing new";
}

TEST(LiveMessages, ALostStateLeavesNoGapButALongSilenceDoes) {
  LiveMessages messages = begun();
  take_states({0, 20, 60, 80, 500, 520}, messages);
  EXPECT_THAT(stretches(messages.portion()),
              ElementsAre(std::pair(0, 2), std::pair(20, 2), std::pair(60, 2), std::pair(500, 2)));
}

TEST(LiveMessages, StatesBesideTheGridAreMovedToIt) {
  LiveMessages messages = begun();
  take_states({3, 21, 38}, messages);
  EXPECT_THAT(stretches(messages.portion()), ElementsAre(std::pair(0, 3)));
}

TEST(LiveMessages, StatesBeforeTheStartAreNotKept) {
  const FinishedRun run = sample_run(1, 1);
  LiveMessages messages(before(run));
  for (Nanoseconds i = 1; i <= 70; ++i) messages.take(state_at(kBegin - i * 20'000'000));
  messages.take(state_at(kBegin));
  messages.take(run.rows.front().record);
  EXPECT_THAT(stretches(messages.portion()), ElementsAre(std::pair(0, 1)));
}

TEST(LiveMessages, TheEndHasTheLastStepsAndAReasonEvenOfARunThatNeverBegan) {
  LiveMessages messages(before(sample_run(2, 1)));
  const std::string portion = messages.last_portion("stopped \xff");
  EXPECT_THAT(of_kind("run", portion), SizeIs(1));
  ASSERT_THAT(of_kind("end", portion), SizeIs(1));
  EXPECT_EQ(of_kind("end", portion)[0].at("reason"), "stopped \uFFFD");
}

}  // namespace
}  // namespace hlc::view
