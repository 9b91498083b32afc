#include "hlc_bridge/view/live_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;
using testing::ElementsAre;

std::vector<std::string> topics_of(const std::vector<SceneMessage>& messages) {
  std::vector<std::string> topics;
  for (const SceneMessage& one : messages) {
    topics.push_back(LiveScene::channels().at(one.channel).topic);
  }
  return topics;
}

TEST(LiveScene, HasTheMapOnceAndThenOnlyWhatIsNew) {
  const FinishedRun run = sample_run(2, 3);
  LiveScene scene(before(run));
  EXPECT_THAT(topics_of(scene.updates()), ElementsAre("scene/map"));
  EXPECT_TRUE(scene.updates().empty());
  scene.take(VehicleState{.vehicle_id = 1, .create_stamp = 40, .pose = {1.0, 2.0, 0.0}});
  scene.take(VehicleState{.vehicle_id = 1, .create_stamp = 60, .pose = {1.5, 2.0, 0.0}});
  scene.take(VehicleState{.vehicle_id = 9, .create_stamp = 60});
  const std::vector<SceneMessage> updates = scene.updates();
  ASSERT_THAT(topics_of(updates), ElementsAre("scene/cars"));
  EXPECT_EQ(updates[0].time, 60U);
  const json entities = json::parse(updates[0].text).at("entities");
  ASSERT_EQ(entities.size(), 1U);
  EXPECT_EQ(entities[0].at("cubes").at(0).at("pose").at("position").at("x"), 1.5);
}

/// Whoever connects now, or was too slow, gets the last message of each channel only.
TEST(LiveScene, EveryMessageHasAllCarsThatAreKnown) {
  const FinishedRun run = sample_run(3, 3);
  LiveScene scene(before(run));
  static_cast<void>(scene.updates());
  scene.take(VehicleState{.vehicle_id = 1, .create_stamp = 40, .speed_mps = 0.5});
  scene.take(run.rows[0].record);
  static_cast<void>(scene.updates());
  scene.take(VehicleState{.vehicle_id = 2, .create_stamp = 60});
  scene.take(run.rows[1].record);
  const std::vector<SceneMessage> updates = scene.updates();
  ASSERT_THAT(topics_of(updates), ElementsAre("scene/cars", "scene/plans", "reports"));
  std::vector<std::string> ids;
  for (const std::size_t i : {0U, 1U}) {
    const json entities = json::parse(updates[i].text).at("entities");
    for (const json& entity : entities) ids.push_back(entity.at("id"));
  }
  EXPECT_THAT(ids, ElementsAre("car 1", "car 2", "plan 1", "plan 2"));
  const json reports = json::parse(updates[2].text).at("reports");
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[0].at("speed_mps"), 0.5);
  EXPECT_TRUE(scene.updates().empty());
}

TEST(LiveScene, AReportIsShownOnceWithItsPlan) {
  const FinishedRun run = sample_run(2, 3);
  LiveScene scene(before(run));
  static_cast<void>(scene.updates());
  scene.take(run.rows[0].record);
  scene.take(run.rows[2].record);  // of the same car
  const std::vector<SceneMessage> updates = scene.updates();
  ASSERT_THAT(topics_of(updates), ElementsAre("scene/plans", "reports"));
  const json plan = json::parse(updates[0].text).at("entities").at(0);
  EXPECT_EQ(plan.at("id"), "plan 1");
  EXPECT_EQ(plan.at("lines").at(0).at("points").size(), 4U);
  const json report = json::parse(updates[1].text).at("reports").at(0);
  EXPECT_EQ(report.at("vehicle"), 1);
  EXPECT_EQ(report.at("step"), run.rows[2].record.report.step.value);
  EXPECT_EQ(report.at("status"), "planned");
  EXPECT_THAT(topics_of(scene.updates()), IsEmpty());
  scene.take(run.rows[0].record);  // late joiners get earlier ones, too
  EXPECT_THAT(topics_of(scene.updates()), IsEmpty());
}

}  // namespace
}  // namespace hlc::view
