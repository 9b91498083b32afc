#pragma once

#include <filesystem>
#include <string>

#include "planner/apps/cli.hpp"

namespace hlc::apps {

/// Folder of this program.
[[nodiscard]] std::filesystem::path program_folder();

/// The shipped scenarios: beside the program, whatever the working directory.
[[nodiscard]] std::filesystem::path shipped_scenarios();

/// The file that a flag means: a file, or any name with an extension, is taken as it is, a bare
/// name means <name>.yaml in the folder. The file need not exist.
[[nodiscard]] std::filesystem::path scenario_named(const std::string& file_or_name,
                                                   const std::filesystem::path& folder);

/// A flag with a file or a name of shipped_scenarios: its value becomes the file. A name that there
/// is not is refused with those that there are.
CLI::Option* takes_scenario(CLI::Option* option);

}  // namespace hlc::apps
