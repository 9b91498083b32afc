#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "planner/common/text_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::fuzz {

/// Calls `read` with a file of these bytes. It is removed when the program ends.
inline void in_new_file(const std::string& name, std::string_view bytes,
                        const std::function<void(const std::filesystem::path&)>& read) {
  static const test::TemporaryFolder kFolder;
  const std::filesystem::path file = kFolder.path() / name;
  std::filesystem::create_directories(file.parent_path());
  write_file(file, bytes);
  read(file);
}

}  // namespace hlc::fuzz
