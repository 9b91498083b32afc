// Files that a user writes or names: the text is that of the file.
#include <filesystem>
#include <sstream>

#include "planner/automaton/automaton_file.hpp"
#include "planner/common/node.hpp"
#include "planner/common/sha256.hpp"
#include "planner/common/temporary_folder.hpp"
#include "planner/common/text_file.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/road/lanelet_map.hpp"
#include "planner/road/lanelets_for_cars.hpp"
#include "planner/road/map_obstacles.hpp"
#include "planner/road/planning_problem.hpp"
#include "planner/road/way_to_goal.hpp"
#include "planner/scenario/lab_file.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "tests/fuzz/in_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/commonroad_samples.hpp"
#include "tests/support/folders.hpp"

namespace hlc::fuzz {
namespace {

std::vector<std::string> shipped(const std::string& folder, const std::string& extension) {
  std::vector<std::string> texts;
  const auto root = std::filesystem::path(test::source_folder()) / "launch_scripts" / folder;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    if (entry.path().extension() == extension) texts.push_back(read_file(entry.path()));
  }
  return texts;
}

/// Whatever was changed, the file's hash is that of its other lines.
std::string with_its_hash(std::string_view bytes) {
  std::string rest;
  std::string text;
  bool is_first = true;
  for (const std::string& line : split(bytes, '\n')) {
    if (line.starts_with("sha256: ")) continue;
    rest += (is_first ? "" : "\n") + line;
    is_first = false;
  }
  return rest.insert(std::min(rest.find('\n'), rest.size() - 1) + 1,
                     "sha256: " + sha256_of(rest) + "\n");
}

/// Of the shipped configuration, standstill and one more trim.
std::string small_automaton() {
  auto configuration = maneuver_design::read_automaton_configuration(
      test::source_folder() + "/launch_scripts/automata/paper.yaml");
  configuration.trims = {configuration.trims[0], configuration.trims[6]};
  configuration.intervals = 4;
  configuration.criteria = {configuration.criteria[1]};
  configuration.subgraphs = {
      {.name = "A", .labels = {configuration.criteria[0].label}, .trims = {{0}, {1}}}};
  configuration.places = {};
  return automaton::to_text(
      maneuver_design::file_of(configuration, maneuver_design::build_automaton(configuration)));
}

}  // namespace

std::vector<Target> planner_file_targets() {
  const auto in_file = [](auto read) {
    return [read](std::string_view bytes) { in_new_file("input", bytes, read); };
  };
  return {
      {"yaml",
       [](std::string_view bytes) { static_cast<void>(parse_yaml(std::string(bytes), "input")); },
       [] { return shipped("automata", ".yaml"); }},
      {"json",
       [](std::string_view bytes) {
         std::istringstream stream{std::string(bytes)};
         static_cast<void>(parse_json(stream, "input"));
       },
       [] { return shipped("problems", ".json"); }},
      {"map",
       [](std::string_view bytes) {
         static_cast<void>(road::parse_map_obstacles(bytes, "input"));
         static_cast<void>(road::parse_lanelet_map(bytes, "input"));
       },
       [] { return shipped("maps", ".xml"); }},
      {"planning_problems",
       [](std::string_view bytes) {
         const std::string xml(bytes);
         const auto for_cars = road::parse_lanelets_for_cars(xml, "input");
         const road::LaneletMap map = road::parse_lanelet_map(xml, "input");
         for (const auto& problem : road::parse_planning_problems(xml, "input")) {
           static_cast<void>(road::way_to_goal(map, for_cars, problem, {4.5, 1.6}));
         }
       },
       [] {
         std::vector<std::string> texts;
         for (const auto& sample : test::commonroad_samples()) texts.push_back(sample.xml);
         return texts;
       }},
      {"scenario",
       [](std::string_view bytes) {
         const Node node = Node::parse_yaml(std::string(bytes), "input");
         static_cast<void>(scenario::parse_scenario(node, "input"));
       },
       [] { return shipped("scenarios", ".yaml"); }},
      {"lab", in_file([](const auto& file) { static_cast<void>(scenario::read_lab(file, 0.2)); }),
       [] { return shipped("labs", ".yaml"); }},
      {"configuration", in_file([](const auto& file) {
         static_cast<void>(maneuver_design::read_automaton_configuration(file));
       }),
       [] { return shipped("automata", ".yaml"); }},
      {"automaton",
       [](std::string_view bytes) {
         in_new_file("input", with_its_hash(bytes), [](const auto& file) {
           static_cast<void>(automaton::read_automaton_file(file));
         });
       },
       [] { return std::vector{small_automaton()}; }},
  };
}

}  // namespace hlc::fuzz
