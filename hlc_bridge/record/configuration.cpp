#include "hlc_bridge/record/configuration.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <system_error>

#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::record {
namespace {

namespace fs = std::filesystem;

/// Location of a file's copy.
fs::path copy_of(const fs::path& run_folder, const fs::path& file) {
  const fs::path full = fs::absolute(file).lexically_normal();
  return run_folder / "configuration" / full.parent_path().filename() / full.filename();
}

/// For YAML: null for none.
std::string text_of(const std::optional<std::string>& value) {
  return value ? quoted_yaml(*value) : "null";
}

std::optional<std::string> text_or_null(const Node& flags, const std::string& key) {
  return flags.is_value(key) ? std::optional(flags.required<std::string>(key)) : std::nullopt;
}

}  // namespace

void keep_configuration(const fs::path& run_folder, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const fs::path copy = copy_of(run_folder, file);
    const fs::path folder = copy.parent_path();
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      throw std::runtime_error(folder.string() + ": cannot be created");
    }
    write_file(copy, read_file(file));
  }
}

std::string flags_yaml(const scenario::ScenarioChoices& choices) {
  const auto path = [](const fs::path& file) { return fs::absolute(file).string(); };
  const auto map = choices.map_file ? std::optional(path(*choices.map_file)) : std::nullopt;
  const auto number = [](const auto& value) { return value ? fmt::to_string(*value) : "null"; };
  return fmt::format(
      "scenario: {}\nprofile: {}\nengine: {}\nsubgraph: {}\npolicy: {}\nmap: {}\ncars: {}\n"
      "seed: {}\nroutes: {}\nsteps: {}\n",
      text_of(path(choices.file)), text_of(choices.profile), text_of(choices.engine),
      text_of(choices.subgraph), text_of(choices.policy), text_of(map), number(choices.cars),
      number(choices.seed), text_of(choices.routes), number(choices.steps));
}

scenario::ScenarioChoices kept_choices(const fs::path& run_folder) {
  const fs::path file = run_folder / "configuration" / "flags.yaml";
  if (!fs::exists(file)) {
    throw std::invalid_argument(file.string() + ": missing; --scenario must be given");
  }
  const Node flags = Node::read_yaml(file);
  scenario::ScenarioChoices choices;
  choices.file = copy_of(run_folder, flags.required<std::string>("scenario"));
  choices.profile = flags.required<std::string>("profile");
  choices.engine = text_or_null(flags, "engine");
  choices.subgraph = text_or_null(flags, "subgraph");
  choices.policy = text_or_null(flags, "policy");
  if (const auto map = text_or_null(flags, "map")) choices.map_file = copy_of(run_folder, *map);
  if (flags.is_value("cars")) choices.cars = flags.required<std::size_t>("cars");
  if (flags.is_value("seed")) choices.seed = flags.required<std::size_t>("seed");
  choices.routes = text_or_null(flags, "routes");
  return choices;
}

}  // namespace hlc::record
