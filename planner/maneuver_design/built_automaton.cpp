#include "planner/maneuver_design/built_automaton.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "planner/automaton/subgraph_yaml.hpp"
#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/sha256.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::maneuver_design {
namespace {

std::string line_of(const LabelledCriterion& criterion) {
  std::string text = "criterion " + quoted_yaml(criterion.label);
  for (const CriterionWeight& one : criterion.weights) {
    text += fmt::format(" {} {}", one.criterion, shortest_text(one.weight));
  }
  if (const auto& point = criterion.front_point) {
    text += fmt::format(" minimise {} bound {} share {}", point->minimised, point->bounded,
                        shortest_text(point->share));
  }
  return text + (criterion.normalised ? " normalised\n" : "\n");
}

/// One line per value, in a fixed order.
std::string canonical_text(const AutomatonConfiguration& c) {
  std::string text =
      fmt::format("schema {}\nvehicle {}\nlimits {}\n", automaton::kAutomatonSchema,
                  automaton::to_yaml(c.vehicle, c.identified), automaton::to_yaml(c.limits));
  for (const automaton::Trim& trim : c.trims) {
    text += fmt::format("trim {} {}\n", shortest_text(trim.speed_mps),
                        shortest_text(trim.steering_rad));
  }
  text += fmt::format("step_s {}\nhorizon_steps {}\nintervals {}\n", shortest_text(c.step_s),
                      c.horizon_steps, c.intervals);
  text += c.edges == EdgeChoice::kAll ? "edges all\n" : "edges subgraphs\n";
  if (c.self_loops != SelfLoops::kTrim) {
    text += "own_steps " + kSelfLoopNames[static_cast<std::size_t>(c.self_loops)] + "\n";
  }
  for (const LabelledCriterion& criterion : c.criteria) text += line_of(criterion);
  for (const automaton::SubgraphSpec& subgraph : c.subgraphs)
    text += "subgraph " + automaton::to_yaml(subgraph) + "\n";
  return text;
}

/// None if the file does not exist, or if a built automaton has its name.
std::optional<std::filesystem::path> configuration_beside(const automaton::AutomatonFile& file,
                                                          const std::filesystem::path& path) {
  std::filesystem::path beside = path.parent_path() / file.configuration_file;
  if (!std::filesystem::exists(beside) || automaton::is_automaton_file(beside)) return std::nullopt;
  return beside;
}

}  // namespace

std::string configuration_sha256(const AutomatonConfiguration& configuration) {
  return sha256_of(canonical_text(configuration));
}

automaton::AutomatonFile file_of(const AutomatonConfiguration& configuration,
                                 automaton::UniversalAutomaton automaton,
                                 std::optional<std::size_t> chosen_intervals) {
  automaton::AutomatonFile file;
  file.configuration_file = std::filesystem::path(configuration.source).filename().string();
  file.configuration_sha256 = configuration_sha256(configuration);
  file.chosen_intervals = chosen_intervals;
  file.horizon_steps = configuration.horizon_steps;
  for (const LabelledCriterion& criterion : configuration.criteria) {
    file.labels.push_back(criterion.label);
  }
  file.subgraphs = configuration.subgraphs;
  file.automaton = std::make_shared<const automaton::UniversalAutomaton>(std::move(automaton));
  return file;
}

void check_is_current(const automaton::AutomatonFile& file, const std::filesystem::path& path,
                      const std::filesystem::path& configuration_path) {
  const AutomatonConfiguration configuration = read_automaton_configuration(configuration_path);
  if (configuration_sha256(configuration) == file.configuration_sha256) return;
  throw std::invalid_argument(fmt::format(
      "{}: stale, built from another state of {}, must be built from its current state; rebuild "
      "it: {}",
      path.string(), configuration_path.string(),
      automaton::rebuild_command(file, path, configuration_path)));
}

automaton::AutomatonFile read_current_automaton_file(const std::filesystem::path& path) {
  automaton::AutomatonFile file = automaton::read_automaton_file(path);
  const auto configuration = configuration_beside(file, path);
  if (configuration) check_is_current(file, path, *configuration);
  return file;
}

AutomatonConfiguration read_configuration_of(const std::filesystem::path& path) {
  if (!automaton::is_automaton_file(path)) return read_automaton_configuration(path);
  const automaton::AutomatonFile file = automaton::read_automaton_file(path);
  const auto beside = configuration_beside(file, path);
  if (!beside) {
    throw std::invalid_argument(
        fmt::format("{}: configuration {} not found in its folder, needed to design maneuvers",
                    path.string(), file.configuration_file));
  }
  check_is_current(file, path, *beside);
  AutomatonConfiguration configuration = read_automaton_configuration(*beside);
  if (file.chosen_intervals) configuration.intervals = *file.chosen_intervals;
  return configuration;
}

}  // namespace hlc::maneuver_design
