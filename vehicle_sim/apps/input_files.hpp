#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace hlc::apps {

/// Name and SHA-256 of each file, as a list in the order of the paths: a campaign continues only if
/// all its input files are unchanged.
/// @throws std::runtime_error naming a file that cannot be read
[[nodiscard]] nlohmann::ordered_json input_files(const std::set<std::filesystem::path>& files);

/// Of the running program: another build is another program, whatever its revision.
[[nodiscard]] std::string this_program_sha256();

}  // namespace hlc::apps
