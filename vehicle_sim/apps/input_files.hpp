#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace hlc {

/// Name and SHA-256 of each file, as a list in the order of the paths: a campaign goes on only
/// where all that it reads is what it was.
/// @throws std::runtime_error naming a file that cannot be read
[[nodiscard]] nlohmann::ordered_json input_files(const std::set<std::filesystem::path>& files);

/// Of the program that runs: another build is another program, whatever its revision says.
[[nodiscard]] std::string this_program_sha256();

}  // namespace hlc
