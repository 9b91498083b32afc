#pragma once

#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "planner/apps/scenario_name.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::apps {

/// Scenario driven if none is named.
inline constexpr const char* kDefaultScenario = "lab_three_cars";
/// Environment variable that names the scenario.
inline constexpr const char* kScenarioVariable = "HLC_SCENARIO";
/// File beside the program with the name of the scenario in its only line.
inline constexpr const char* kDefaultScenarioFile = "default_scenario";

/// The line of kDefaultScenarioFile; none: there is no such file.
/// @throws std::invalid_argument naming the file unless it is one line
inline std::optional<std::string> default_scenario_line(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kDefaultScenarioFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  std::istringstream stream(read_regular_file(file, "one line with a scenario's name or file"));
  std::string line;
  std::string rest;
  if (!(stream >> line) || stream >> rest) {
    throw std::invalid_argument(
        file.string() + ": must be one line with a scenario's name or file, without blanks");
  }
  return line;
}

/// The scenario's file, named, in this order, by the flag --scenario, the environment variable
/// HLC_SCENARIO and the file default_scenario beside the program: the lab control centre passes no
/// flag --scenario. A file is taken as it is (in default_scenario: from the program's folder); a
/// name means scenarios/<name>.yaml beside the program, where the installation puts them.
/// @param flag         empty: not given
/// @param environment  value of the variable; empty: not given
/// @param folder       of the program
/// @throws std::invalid_argument naming the variable or the file if the scenario that it names does
/// not exist (not for the flag: the reader of scenarios does)
inline std::filesystem::path scenario_file(const std::filesystem::path& flag,
                                           const std::string& environment,
                                           const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const auto found = [&folder](const fs::path& name) {
    return scenario_named(name.string(), folder / "scenarios");
  };
  const auto checked = [](const std::string& source, const std::string& name, fs::path file) {
    if (fs::is_regular_file(file)) return file;
    throw std::invalid_argument(source + " = " + one_line(name) +
                                ", must name an existing scenario; no file " + file.string());
  };
  if (!flag.empty()) return found(flag);
  if (!environment.empty()) return checked(kScenarioVariable, environment, found(environment));
  if (const auto line = default_scenario_line(folder)) {
    const fs::path beside = folder / *line;
    return checked((folder / kDefaultScenarioFile).string(), *line,
                   fs::is_regular_file(beside) ? beside : found(*line));
  }
  return found(kDefaultScenario);
}

}  // namespace hlc::apps
