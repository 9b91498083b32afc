// The schema of scenarios for editors has the keys of the reader. That it accepts the shipped
// scenarios: tests/verify/scenario_schema.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/common/text_file.hpp"
#include "planner/controller/coordination_rules.hpp"
#include "planner/coordination/coupling_rule.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "planner/right_of_way/grant_order.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::schema_test {
namespace {

using Keys = std::set<std::string>;

/// An object of the schema, and scenarios with an unknown key there: one for each of its forms,
/// since a form knows its own keys only.
struct Place {
  std::string name;  ///< of the schema's definition; "scenario": the whole
  std::vector<std::string> scenarios;
};

const std::string kBegin = "{name: x, steps: 1, automaton: a, subgraph: s, ";
const std::string kRoutes = "routes: [{name: r, lanelets: {M: [1]}}], ";
const std::string kVehicles = kRoutes + "vehicles: [{id: 1, route: r, start_m: 0}], ";

std::string with_obstacle(const std::string& obstacle) {
  return kBegin + kVehicles + "obstacles: [" + obstacle + "]}";
}

const std::string kLimits =
    "limits: {speed_mps: 1, acceleration_mps2: 1, deceleration_mps2: 1, curvature_per_m: 1}";
const std::string kGuest = "id: 9, start: {x_m: 0, y_m: 0}, ";

std::string with_guest(const std::string& guest) {
  return kBegin + kVehicles + "guests: [{" + guest + "}]}";
}

std::string with_policy(const std::string& policy) {
  return kBegin + kVehicles + "policies: {p: " + policy + "}}";
}

std::string with_rule(const std::string& rule) { return with_policy("{rules: [" + rule + "]}"); }

const std::vector<Place>& places() {
  static const std::vector<Place> kAll{
      {"scenario",
       {kBegin + kVehicles + "zz: 1}", kBegin + kRoutes + "draw: {cars: 1, routes: [r]}, zz: 1}",
        kBegin + "circle: {cars: 1, radius_m: 1, centre_x_m: 0, centre_y_m: 0}, zz: 1}"}},
      {"priorities", {kBegin + kVehicles + "priorities: {zz: 1}}"}},
      {"obstacle", {with_obstacle("{name: a, zz: 1}")}},
      {"guest",
       {with_guest(kGuest + kLimits + ", drive: by_hand, zz: 1"),
        with_guest(kGuest + kLimits + ", drive: track, track: t.csv, zz: 1"),
        with_guest(kGuest + kLimits +
                   ", drive: wander, area: {circle: {x_m: 0, y_m: 0, radius_m: 1}}, zz: 1")}},
      {"pose", {with_guest("id: 9, start: {x_m: 0, y_m: 0, zz: 1}, " + kLimits)}},
      {"guest_limits", {with_guest(kGuest + "limits: {zz: 1}")}},
      {"footprint", {with_guest(kGuest + kLimits + ", footprint: {zz: 1}")}},
      {"rectangle",
       {with_obstacle("{name: a, rectangle: {x_m: 0, y_m: 0, length_m: 1, width_m: 1, zz: 1}}")}},
      {"disc", {with_obstacle("{name: a, circle: {x_m: 0, y_m: 0, radius_m: 1, zz: 1}}")}},
      {"area", {kBegin + kRoutes + "vehicles: [{id: 1, route: r, start_m: 0, goal: {zz: 1}}]}"}},
      {"circle", {kBegin + "circle: {cars: 1, radius_m: 1, centre_x_m: 0, centre_y_m: 0, zz: 1}}"}},
      {"route",
       {kBegin + "routes: [{name: r, lanelets: {M: [1]}, zz: 1}]}",
        kBegin + "routes: [{name: r, lanelets: {M: [1]}}, {name: t, of: r, from: 1, zz: 1}]}"}},
      {"section",
       {kBegin + "routes: [{name: r, lanelets: {M: [1]}, sections: {M: [{from: 1, to: 1, "
                 "reference_speed_mps: 1, zz: 1}]}}]}"}},
      {"draw",
       {kBegin + kRoutes + "draw: {cars: 1, routes: [r], zz: 1}}",
        kBegin + "routes: random, draw: {cars: 1, zz: 1}}"}},
      {"vehicle",
       {kBegin + kRoutes + "vehicles: [{id: 1, route: r, start_m: 0, zz: 1}]}",
        kBegin + "routes: random, vehicles: [{id: 1, lanelet: 1, start_m: 0, zz: 1}]}"}},
      {"policy", {with_policy("{rules: [{battery: {below_v: 7, request: {}}}], zz: 1}")}},
      {"zone", {with_policy("{zones: [{x_m: [0, 1], y_m: [0, 1], max_speed_mps: 1, zz: 1}]}")}},
      {"request", {with_rule("{battery: {below_v: 7, request: {zz: 1}}}")}},
      {"change", {with_rule("{time: [{from_s: 0, request: {}, zz: 1}]}")}},
      {"situation", {with_rule("{situation: {open_road: {}, conflict: {}, zz: 1}}")}},
      {"battery", {with_rule("{battery: {below_v: 7, request: {}, zz: 1}}")}},
      {"look_ahead",
       {with_rule("{look_ahead: {candidates: [{}, {}], max_expansions: 1, zz: 1}}")}}};
  return kAll;
}

const nlohmann::json& schema() {
  static const nlohmann::json kSchema = nlohmann::json::parse(
      read_file(test::source_folder() + "/launch_scripts/scenarios/schema.json"));
  return kSchema;
}

const nlohmann::json& object_of(const std::string& name) {
  return name == "scenario" ? schema() : schema().at("definitions").at(name);
}

Keys keys_in_schema(const std::string& name) {
  Keys keys;
  const nlohmann::json& properties = object_of(name).at("properties");
  for (const auto& [key, value] : properties.items()) keys.insert(key);
  return keys;
}

/// Those that the reader lists when it refuses the unknown key.
Keys keys_of_reader(const std::string& scenario) {
  std::string text;
  try {
    static_cast<void>(parse_scenario(Node::parse_yaml(scenario, "file.yaml"), "file.yaml"));
  } catch (const std::invalid_argument& error) {
    text = error.what();
  }
  const std::string begin = "zz = 1, unknown key; known keys: ";
  const std::size_t found = text.find(begin);
  EXPECT_NE(found, std::string::npos) << scenario << '\n' << text;
  if (found == std::string::npos) return {};
  std::istringstream list(text.substr(found + begin.size()));
  Keys keys;
  for (std::string key; std::getline(list >> std::ws, key, ',');) keys.insert(key);
  return keys;
}

TEST(ScenarioSchema, HasTheKeysOfTheReader) {
  for (const Place& place : places()) {
    Keys keys;
    for (const std::string& scenario : place.scenarios) keys.merge(keys_of_reader(scenario));
    EXPECT_EQ(keys_in_schema(place.name), keys) << place.name;
  }
}

void expect_names(const nlohmann::json& place, const std::vector<std::string>& names) {
  EXPECT_THAT(place.at("enum").get<std::vector<std::string>>(),
              testing::UnorderedElementsAreArray(names));
}

TEST(ScenarioSchema, HasTheNamesOfTheRegistries) {
  const nlohmann::json& keys = schema().at("properties");
  expect_names(schema().at("definitions").at("strategy"), coordination::priority_strategy_names());
  expect_names(keys.at("coupling"), coordination::coupling_rule_names());
  expect_names(keys.at("right_of_way_order"), right_of_way::grant_order_names());
  std::vector<std::string> engine_names;
  for (const NamedEngine& one : engines()) engine_names.emplace_back(one.name);
  expect_names(keys.at("engine"), engine_names);
  std::vector<std::string> coordination_names;
  for (const auto& [name, rule] : controller::coordination_rules()) {
    coordination_names.push_back(name);
  }
  expect_names(keys.at("coordination"), coordination_names);
  std::vector<std::string> reference_names;
  for (const road::NamedReferenceRule& one : road::reference_rules()) {
    reference_names.emplace_back(one.name);
  }
  expect_names(keys.at("reference_rule"), reference_names);
}

// A definition that is not compared could have any keys.
TEST(ScenarioSchema, HasNoOtherObjects) {
  Keys compared{"scenario", "rule"};  // of a rule the reader names the kinds, not keys
  for (const Place& place : places()) compared.insert(place.name);
  const nlohmann::json& definitions = schema().at("definitions");
  for (const auto& [name, definition] : definitions.items()) {
    EXPECT_TRUE(!definition.contains("properties") || compared.contains(name)) << name;
  }
}

}  // namespace
}  // namespace hlc::scenario::schema_test
