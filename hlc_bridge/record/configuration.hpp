#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/scenario/scenario.hpp"

namespace hlc::record {

/// Copies the configuration files of a run into `<run_folder>/configuration/<folder>/<file>`, where
/// <folder> is the name of the file's own folder: relative paths such as `../maps/lab_like.xml`
/// stay valid, so the run can be repeated from its folder.
/// @throws std::runtime_error naming the file
void keep_configuration(const std::filesystem::path& run_folder,
                        const std::vector<std::filesystem::path>& files);

/// `configuration/flags.yaml`: the choices of a run besides the files; run_lab.sh writes the same
/// keys and its own.
[[nodiscard]] std::string flags_yaml(const scenario::ScenarioChoices& choices);

/// The choices of a run from its flags.yaml, with the copies in its own folder.
/// @throws std::invalid_argument naming file, line, key, value and bound
[[nodiscard]] scenario::ScenarioChoices kept_choices(const std::filesystem::path& run_folder);

}  // namespace hlc::record
