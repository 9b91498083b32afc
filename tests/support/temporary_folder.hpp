#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "planner/common/temporary_folder.hpp"

namespace hlc::test {

using hlc::TemporaryFolder;

inline void put(const std::filesystem::path& file, const std::string& content) {
  std::ofstream{file, std::ios::binary} << content;
}

}  // namespace hlc::test
