#include "hlc_bridge/view/page_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;

std::vector<json> messages_of(const FinishedRun& run) { return json::parse(page_messages(run)); }

/// The messages of this kind, of a vehicle if it is not 0.
std::vector<json> of_kind(const FinishedRun& run, const std::string& kind, int vehicle = 0) {
  std::vector<json> found;
  for (const json& message : messages_of(run)) {
    if (message.at("kind") != kind) continue;
    if (vehicle == 0 || message.at("vehicle") == vehicle) found.push_back(message);
  }
  return found;
}

/// The values of a column of differences.
std::vector<double> sums(const json& column, double unit) {
  std::vector<double> values;
  std::int64_t sum = 0;
  for (const json& difference : column) {
    sum += difference.get<std::int64_t>();
    values.push_back(static_cast<double>(sum) * unit);
  }
  return values;
}

TEST(PageMessages, PlannedAndDrivenPosesReadBackToTenthsOfMillimetres) {
  const FinishedRun run = sample_run(3, 20);
  const json steps = of_kind(run, "steps", 3).at(0);
  const std::vector<double> x = sums(steps.at("x"), 1e-4);
  const std::vector<double> heading = sums(steps.at("yaw"), 1e-3);
  ASSERT_EQ(x.size(), 20U);
  for (const result::StepRecord& row : run.rows) {
    if (row.record.report.vehicle != VehicleId{3}) continue;
    EXPECT_NEAR(x[row.step], row.record.report.planned_pose.x_m, 0.51e-4);
    EXPECT_NEAR(heading[row.step], row.record.report.planned_pose.heading_rad, 0.51e-3);
  }
  const std::vector<json> drives = of_kind(run, "drive", 3);
  ASSERT_EQ(drives.size(), 1U);
  EXPECT_EQ(drives[0].at("tick_ms"), 20);
  EXPECT_EQ(drives[0].at("begin_ms"), 0);
  const std::vector<double> y = sums(drives[0].at("y"), 1e-4);
  const result::Drive& drive = run.drives.at(3);
  ASSERT_EQ(y.size(), drive.size());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], drive[i].pose.y_m, 0.51e-4);
}

TEST(PageMessages, AReportNamesTheOtherCars) {
  const json steps = of_kind(sample_run(3, 20), "steps", 2).at(0);
  const json& columns = steps.at("columns");
  const auto set = [&](const char* column, std::size_t step) {
    return steps.at("sets").at(columns.at(column).at(step).get<std::size_t>());
  };
  EXPECT_EQ(set("waits_for", kWaitsFrom - 1), json::array());
  EXPECT_EQ(set("waits_for", kWaitsFrom), json({1}));
  EXPECT_EQ(set("coupled", 0), json({1}));
  EXPECT_EQ(set("missing", 0), json::array());
  EXPECT_EQ(set("blocked_by", kFallsBackIn - 1), json::array());
  EXPECT_EQ(set("blocked_by", kFallsBackIn), json({3}));
  EXPECT_EQ(columns.at("waits_since").at(kFallsBackIn), kWaitsFrom);
  const json run = of_kind(sample_run(3, 20), "run").at(0);
  EXPECT_EQ(run.at("reasons").at(columns.at("reason").at(kFallsBackIn).get<std::size_t>()),
            "conflict");
}

TEST(PageMessages, TheManeuversOfAPlanAreFoundByTheirNumbers) {
  const FinishedRun run = sample_run(3, 20);
  const json maneuvers = of_kind(run, "maneuvers").at(0).at("maneuvers");
  EXPECT_EQ(maneuvers.size(), 2U);
  const json steps = of_kind(run, "steps", 1).at(0);
  EXPECT_EQ(of_kind(run, "run").at(0).at("tables").at("plan"), "sets");
  const auto plan = steps.at("columns").at("plan").at(19).get<std::size_t>();
  EXPECT_EQ(steps.at("sets").at(plan), json({0, 0, 0}));
  EXPECT_EQ(maneuvers.at(0).at("x").size(), 11U);
  EXPECT_GE(maneuvers.at(0).at("area").size(), 2 * 3U);
}

TEST(PageMessages, AGapInARecordBeginsAStretchOfItsOwn) {
  FinishedRun run = sample_run(1, 20);
  result::Drive& drive = run.drives.at(1);
  drive.erase(drive.begin() + 50, drive.begin() + 80);
  const std::vector<json> drives = of_kind(run, "drive");
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_EQ(drives[0].at("x").size(), 50U);
  EXPECT_EQ(drives[1].at("begin_ms"), 1600);
}

TEST(PageMessages, WhatWasDrivenBeforeTheStartIsLeftOut) {
  FinishedRun run = sample_run(1, 20);
  run.drives.at(1).insert(run.drives.at(1).begin(), {.t = 0, .pose = {9.0, 9.0, 0.0}});
  EXPECT_EQ(of_kind(run, "drive").at(0).at("begin_ms"), 0);
}

TEST(PageMessages, NameTheRoundsOfMessagesOnlyIfThereAreTwo) {
  FinishedRun run = sample_run(1, 20);
  const auto about = [&run] { return of_kind(run, "run").at(0).at("about").get<std::string>(); };
  EXPECT_THAT(about(), Not(HasSubstr("rounds")));
  run.description.has_two_rounds = true;
  EXPECT_THAT(about(), HasSubstr("two rounds of messages"));
}

TEST(PageMessages, ACarThatIsNotInTheRunIsLeftOut) {
  FinishedRun run = sample_run(3, 20);
  run.facts.vehicle_ids = {1, 2};
  EXPECT_EQ(of_kind(run, "run").at(0).at("vehicles").size(), 2U);
  EXPECT_TRUE(of_kind(run, "steps", 3).empty());
  EXPECT_TRUE(of_kind(run, "drive", 3).empty());
}

TEST(PageMessages, TheExplanationsOfAVehicleAreOneMessage) {
  FinishedRun run = sample_run(3, 20);
  EXPECT_TRUE(of_kind(run, "why").empty());
  run.explanations = {
      {.step = kWaitsFrom, .last = 7, .vehicle = VehicleId{2}, .text = "waits\nfor <1>"},
      {.step = kFallsBackIn, .last = 8, .vehicle = VehicleId{2}, .text = "keeps"},
      {.step = 9, .last = 9, .vehicle = VehicleId{3}, .text = "misses"}};
  const std::vector<json> whys = of_kind(run, "why");
  ASSERT_EQ(whys.size(), 2U);
  EXPECT_EQ(whys[0],
            json({{"kind", "why"},
                  {"vehicle", 2},
                  {"steps", {{kWaitsFrom, 7, "waits\nfor <1>"}, {kFallsBackIn, 8, "keeps"}}}}));
  EXPECT_EQ(whys[1].at("steps"), json::array({json::array({9, 9, "misses"})}));
}

TEST(PageMessages, ARunWithoutStepsHasAllKindsThatAreNotOfSteps) {
  const FinishedRun run = sample_run(2, 0);
  std::set<std::string> kinds;
  for (const json& message : messages_of(run)) kinds.insert(message.at("kind"));
  EXPECT_EQ(kinds, (std::set<std::string>{"run", "maneuvers", "log"}));
  FinishedRun not_started = run;
  not_started.facts.first_step.reset();
  EXPECT_EQ(page_messages(not_started), page_messages(run));
}

TEST(PageMessages, NumbersAndTextsThatJsonDoesNotAllowAreReplaced) {
  FinishedRun run = sample_run(2, 20, "\xff\xfe");
  run.rows.front().record.report.cost_m2 = std::numeric_limits<double>::infinity();
  run.drives.at(1)[3].pose.x_m = std::numeric_limits<double>::quiet_NaN();
  run.log.push_back({.process = "p", .stamp = {}, .level = {}, .text = "\x80", .run_s = {}});
  EXPECT_EQ(of_kind(run, "steps", 1).at(0).at("columns").at("cost_m2").at(0), 0);
}

}  // namespace
}  // namespace hlc::view
