#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/scenario/scenario.hpp"

namespace hlc {

/// Copies the files that a run was configured with into
/// `<run_folder>/configuration/<folder>/<file>`, where <folder> is the name of the folder that a
/// file lies in: paths from one to another such as
/// `../maps/lab_like.xml` stay good, so the run can be repeated from its folder.
/// @throws std::runtime_error naming the file
void keep_configuration(const std::filesystem::path& run_folder,
                        const std::vector<std::filesystem::path>& files);

/// `configuration/flags.yaml`: what a run was driven with, beside the files; run_lab.sh writes the
/// same keys and its own.
[[nodiscard]] std::string flags_yaml(const ScenarioChoices& choices);

/// What a run was driven with, by its flags.yaml, from the copies in its own folder.
/// @throws std::invalid_argument naming file, line, key, value and what is allowed
[[nodiscard]] ScenarioChoices kept_choices(const std::filesystem::path& run_folder);

}  // namespace hlc
