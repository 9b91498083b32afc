// What viewers demand of the JSON schemas of a recording and of a run under way.
#include "hlc_bridge/view/foxglove_schemas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "hlc_bridge/view/foxglove_channels.hpp"
#include "hlc_bridge/view/live_scene.hpp"
#include "hlc_bridge/view/page_files.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"
#include "tests/support/folders.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;

FinishedRun run_with_log() {
  FinishedRun run = sample_run(3, 10);
  run.log = {{.process = "lab_control", .level = "info", .text = "begins"}};
  return run;
}

struct Topic {
  std::string type;
  json schema;
  std::vector<json> messages;
};

std::map<std::string, Topic> recorded_topics() {
  std::map<std::string, Topic> topics;
  for (const mcap::JsonChannel& channel : foxglove_channels(run_with_log(), std::nullopt)) {
    Topic& topic = topics[channel.topic];
    topic = {channel.type, json::parse(channel.schema), {}};
    for (const auto& [time, text] : channel.messages) topic.messages.push_back(json::parse(text));
  }
  return topics;
}

std::map<std::string, Topic> live_topics() {
  const FinishedRun run = sample_run(3, 10);
  LiveScene scene(before(run));
  scene.take(VehicleState{.vehicle_id = 1, .create_stamp = 40});
  scene.take(run.rows.front().record);
  std::map<std::string, Topic> topics;
  for (const SceneMessage& message : scene.updates()) {
    const SceneChannel& channel = LiveScene::channels().at(message.channel);
    topics[channel.topic] = {
        channel.type, json::parse(channel.schema), {json::parse(message.text)}};
  }
  return topics;
}

void expect_complete(const json& schema, const std::string& place) {
  const std::string type = schema.value("type", "none");
  if (type == "object") {
    ASSERT_TRUE(schema.contains("properties")) << place;
    EXPECT_FALSE(schema.at("properties").empty()) << place;
    for (const auto& [name, member] : schema.at("properties").items()) {
      expect_complete(member, place + "." + name);
    }
  } else if (type == "array") {
    ASSERT_TRUE(schema.contains("items")) << place;
    expect_complete(schema.at("items"), place + "[]");
  } else {
    EXPECT_THAT(type, testing::AnyOf("number", "integer", "string", "boolean")) << place;
  }
}

bool is_of_type(const json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  return type == "array" ? value.is_array() : value.is_object();
}

void expect_described(const json& value, const json& schema, const std::string& place) {
  ASSERT_TRUE(is_of_type(value, schema.at("type"))) << place << ": " << value;
  if (value.is_array()) {
    for (const json& item : value) expect_described(item, schema.at("items"), place + "[]");
  }
  if (!value.is_object()) return;
  for (const auto& [name, member] : value.items()) {
    ASSERT_TRUE(schema.at("properties").contains(name)) << place << "." << name;
    expect_described(member, schema.at("properties").at(name), place + "." + name);
  }
}

void expect_readable(const std::map<std::string, Topic>& topics) {
  for (const auto& [name, topic] : topics) {
    EXPECT_EQ(topic.schema.at("title"), topic.type);
    expect_complete(topic.schema, name);
    EXPECT_FALSE(topic.messages.empty()) << name;
    for (const json& message : topic.messages) expect_described(message, topic.schema, name);
  }
}

TEST(FoxgloveSchemas, EveryObjectHasItsPropertiesEveryArrayItsItemsAndNoMessageHasMore) {
  expect_readable(recorded_topics());
  expect_readable(live_topics());
  EXPECT_EQ(live_topics().size(), LiveScene::channels().size());
}

TEST(FoxgloveSchemas, ARunUnderWayHasTheTopicsOfItsRecordingButTheLog) {
  std::map<std::string, Topic> recorded = recorded_topics();
  EXPECT_EQ(recorded.erase("log"), 1U);
  const std::map<std::string, Topic> live = live_topics();
  ASSERT_EQ(recorded.size(), live.size());
  for (const auto& [name, topic] : recorded) {
    ASSERT_TRUE(live.contains(name)) << name;
    EXPECT_EQ(live.at(name).type, topic.type);
    EXPECT_EQ(live.at(name).schema, topic.schema);
  }
}

json layout() {
  std::ifstream file(test::source_folder() + "/launch_scripts/foxglove_layout.json");
  return json::parse(file).at("configById");
}

TEST(FoxgloveLayout, ItsPanelsShowWhatARecordingHas) {
  const std::map<std::string, Topic> topics = recorded_topics();
  const json panels = layout();
  for (const auto& [topic, settings] : panels.at("3D!scene").at("topics").items()) {
    EXPECT_TRUE(topics.contains(topic)) << topic;
  }
  EXPECT_TRUE(topics.contains(panels.at("RawMessages!reports").at("topicPath")));
  EXPECT_TRUE(topics.contains(panels.at("RosOut!log").at("topicToRender")));
}

/// The curve of car i is that of its reports, in its colour of the page.
TEST(FoxgloveLayout, ItsPlotsShowMembersOfReportsInTheColoursOfTheCars) {
  const json report =
      recorded_topics().at("reports").schema.at("properties").at("reports").at("items");
  const std::string& css = page_files().at("page.css");
  const json panels = layout();
  for (const char* plot : {"Plot!speed", "Plot!planning"}) {
    const json& paths = panels.at(plot).at("paths");
    ASSERT_EQ(paths.size(), 10U);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::string car = std::to_string(i + 1);
      const std::string path = paths[i].at("value");
      const std::string begin = "reports.reports[:]{vehicle==" + car + "}.";
      ASSERT_THAT(path, testing::StartsWith(begin));
      EXPECT_TRUE(report.at("properties").contains(path.substr(begin.size()))) << path;
      EXPECT_EQ(paths[i].at("label"), "car " + car);
      const std::string name = "--car-" + std::to_string(i % 8) + ": ";
      EXPECT_EQ(paths[i].at("color"), css.substr(css.find(name) + name.size(), 7));
    }
  }
}

}  // namespace
}  // namespace hlc::view
