#include "hlc_bridge/view/foxglove_channels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hlc_bridge/view/page_files.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using Messages = std::vector<std::pair<Nanoseconds, nlohmann::json>>;

constexpr Nanoseconds kRecordedFrom = 123'456'789;

/// Of one topic; all as JSON.
Messages messages_of(const FinishedRun& run, const std::string& topic) {
  Messages messages;
  for (const mcap::JsonChannel& channel : foxglove_channels(run, kRecordedFrom)) {
    if (channel.topic != topic) continue;
    for (const auto& [time, text] : channel.messages) {
      messages.emplace_back(time, nlohmann::json::parse(text));
    }
  }
  return messages;
}

Nanoseconds time_of(const nlohmann::json& stamp) {
  return stamp.at("sec").get<Nanoseconds>() * 1'000'000'000 + stamp.at("nsec").get<Nanoseconds>();
}

TEST(FoxgloveChannels, EveryCarIsWhereItDroveEvery40Milliseconds) {
  const FinishedRun run = sample_run(3, 10);
  std::map<int, std::vector<Nanoseconds>> times;
  for (const auto& [time, update] : messages_of(run, "scene/cars")) {
    for (const auto& entity : update.at("entities")) {
      const int id = std::stoi(entity.at("texts").at(0).at("text").get<std::string>());
      EXPECT_EQ(entity.at("id"), "car " + std::to_string(id));
      EXPECT_EQ(time_of(entity.at("timestamp")), time);
      const result::Drive& drive = run.drives.at(static_cast<std::uint8_t>(id));
      const auto pose = result::driven_pose_at(drive, time);
      ASSERT_TRUE(pose);
      const auto& cube = entity.at("cubes").at(0).at("pose");
      EXPECT_DOUBLE_EQ(cube.at("position").at("x"), pose->x_m);
      EXPECT_DOUBLE_EQ(cube.at("position").at("y"), pose->y_m);
      const auto& turn = cube.at("orientation");
      const double yaw = 2.0 * std::atan2(turn.at("z").get<double>(), turn.at("w").get<double>());
      EXPECT_NEAR(std::remainder(yaw - pose->heading_rad, 2.0 * M_PI), 0.0, 1e-12);
      times[id].push_back(time);
    }
  }
  ASSERT_EQ(times.size(), 3U);
  for (const auto& [id, of_car] : times) {
    ASSERT_EQ(of_car.size(), 50U) << id;
    for (std::size_t i = 1; i < of_car.size(); ++i) {
      EXPECT_EQ(of_car[i] - of_car[i - 1], 40'000'000U);
    }
  }
}

/// After a jump in time viewers have the last message of a topic only.
TEST(FoxgloveChannels, EveryMessageHasAllCarsThatDriveThenAlsoIfTheyAreRecordedAtOtherTimes) {
  FinishedRun run = sample_run(3, 10);
  for (result::DrivenSample& sample : run.drives.at(2)) sample.t += 20'000'000;
  result::Drive& third = run.drives.at(3);
  third.resize(third.size() / 2);
  for (result::DrivenSample& sample : third) sample.t += 3'000'000;
  std::size_t of_three = 0;
  std::size_t of_two = 0;
  for (const auto& [time, update] : messages_of(run, "scene/cars")) {
    std::size_t driving = 0;
    for (const auto& [id, drive] : run.drives) {
      if (result::driven_pose_at(drive, time)) ++driving;
    }
    EXPECT_EQ(update.at("entities").size(), driving) << time;
    if (driving == 3) ++of_three;
    if (driving == 2) ++of_two;
  }
  EXPECT_EQ(of_three, 24U);
  EXPECT_EQ(of_two, 25U);
}

/// Of page.css, "#d55e00", as numbers in [0, 1].
std::vector<double> colour_of_page(std::size_t car) {
  const std::string& css = page_files().at("page.css");
  const std::string name = "--car-" + std::to_string(car) + ": #";
  const std::string hex = css.substr(css.find(name) + name.size(), 6);
  std::vector<double> colour;
  for (std::size_t i = 0; i < 6; i += 2) {
    colour.push_back(std::stoi(hex.substr(i, 2), nullptr, 16) / 255.0);
  }
  return colour;
}

TEST(FoxgloveChannels, CarsHaveTheColoursThatTheyHaveOnThePage) {
  const Messages cars = messages_of(sample_run(9, 1), "scene/cars");
  const auto& entities = cars.at(0).second.at("entities");
  ASSERT_EQ(entities.size(), 9U);
  for (std::size_t car = 0; car < entities.size(); ++car) {
    const auto& colour = entities[car].at("cubes").at(0).at("color");
    const std::vector<double> expected = colour_of_page(car % 8);
    EXPECT_NEAR(colour.at("r"), expected[0], 1e-3) << car;
    EXPECT_NEAR(colour.at("g"), expected[1], 1e-3) << car;
    EXPECT_NEAR(colour.at("b"), expected[2], 1e-3) << car;
  }
}

TEST(FoxgloveChannels, EveryStepHasTheWholePlanOfEveryCarAndItsStatus) {
  const FinishedRun run = sample_run(3, 10);
  const Messages steps = messages_of(run, "scene/plans");
  ASSERT_EQ(steps.size(), 10U);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].first, (*run.facts.first_step + k) * run.facts.period);
    const auto& entities = steps[k].second.at("entities");
    ASSERT_EQ(entities.size(), 3U);
    for (std::size_t i = 0; i < entities.size(); ++i) {
      const coordination::Report& report = run.rows.at(3 * k + i).record.report;
      const auto& path = entities[i].at("lines").at(0).at("points");
      EXPECT_EQ(path.size(), report.plan.size() + 1);
      EXPECT_NEAR(path.at(0).at("x"), report.planned_pose.x_m, 5.1e-5);
      EXPECT_EQ(entities[i].at("metadata").at(0).at("value"), to_string(report.status));
      EXPECT_EQ(entities[i].at("metadata").at(1).at("value"), "trim, trim, trim");
      EXPECT_EQ(entities[i].at("lines").size(), report.plan.size() + 1) << "the path, and areas";
    }
  }
}

TEST(FoxgloveChannels, TheMapHasBothBoundsOfEveryLaneAndTheRoutes) {
  const Messages map = messages_of(sample_run(3, 10), "scene/map");
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map.front().first, kRecordedFrom);
  const auto& entities = map.front().second.at("entities");
  ASSERT_EQ(entities.size(), 4U);
  EXPECT_EQ(entities.at(0).at("lines").size(), 6U);
  EXPECT_EQ(entities.at(3).at("id"), "route 3");
}

TEST(FoxgloveChannels, TheMapHasTheOutlineOfEveryObstacle) {
  FinishedRun run = sample_run(2, 5);
  run.description.obstacles = {
      {.name = "cone", .area_m = footprint_area({0.4, 0.2}, {1.0, 2.0, 0.0})}};
  const Messages map = messages_of(run, "scene/map");
  const auto& entities = map.front().second.at("entities");
  ASSERT_EQ(entities.at(1).at("id"), "obstacles");
  ASSERT_EQ(entities.at(1).at("lines").size(), 1U);
  EXPECT_EQ(entities.at(1).at("lines").at(0).at("points").size(), 4U);
}

TEST(FoxgloveChannels, EveryStepHasTheReportsOfAllCarsInWordsAndTheirSpeeds) {
  FinishedRun run = sample_run(3, 10);
  run.drives.erase(3);
  const Messages steps = messages_of(run, "reports");
  ASSERT_EQ(steps.size(), 10U);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_EQ(steps[k].first, (*run.facts.first_step + k) * run.facts.period);
    const auto& reports = steps[k].second.at("reports");
    ASSERT_EQ(reports.size(), 3U);
    const bool falls_back = k == kFallsBackIn;
    EXPECT_EQ(reports[1].at("status"), falls_back ? "fallback" : "planned") << k;
    EXPECT_EQ(reports[0].at("speed_mps"), run.drives.at(1).at(10 * k).speed_mps);
    EXPECT_GT(reports[0].at("speed_mps"), 0.0);
    EXPECT_FALSE(reports[2].contains("speed_mps")) << "nobody knows it";
  }
}

TEST(FoxgloveChannels, LogLinesHaveTheirTimeToTheMillisecondOrThatOfTheLineBefore) {
  FinishedRun run = sample_run(1, 10);
  run.log = {{.process = "middleware_1", .level = "info", .text = "no time"},
             {.process = "middleware_1", .level = "info", .text = "early", .run_s = -2.0},
             {.process = "middleware_1", .level = "warning", .text = "late", .run_s = 0.5 - 2e-7},
             {.process = "middleware_1", .text = "its second line"}};
  const Messages log = messages_of(run, "log");
  const Nanoseconds late = *run.facts.first_step * run.facts.period + 500'000'000;
  const std::vector<Nanoseconds> times{kRecordedFrom, kRecordedFrom, late, late};
  ASSERT_EQ(log.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(log[i].first, times[i]);
    EXPECT_EQ(time_of(log[i].second.at("timestamp")), times[i]);
    EXPECT_EQ(log[i].second.at("message"), run.log[i].text);
  }
  EXPECT_EQ(log[2].second.at("level"), 3);
}

TEST(FoxgloveChannels, ARunThatNeverBeganHasAMapOnly) {
  FinishedRun run = sample_run(2, 0);
  run.facts.first_step.reset();
  EXPECT_EQ(messages_of(run, "scene/map").size(), 1U);
  EXPECT_TRUE(messages_of(run, "scene/cars").empty());
  EXPECT_TRUE(messages_of(run, "scene/plans").empty());
  EXPECT_TRUE(messages_of(run, "reports").empty());
}

}  // namespace
}  // namespace hlc::view
