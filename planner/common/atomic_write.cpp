#include "planner/common/atomic_write.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

namespace hlc {
namespace {

namespace fs = std::filesystem;

/// A new file beside `path`, opened for writing; null if there cannot be one. No other process and
/// no other thread has it, and none that was there before is taken.
std::pair<fs::path, std::FILE*> new_file_beside(const fs::path& path) {
  for (int number = 0;; ++number) {
    fs::path name = path;
    name += "." + std::to_string(getpid()) + "_" + std::to_string(number) + ".part";
    std::FILE* const file = std::fopen(name.c_str(), "wbx");
    if (file != nullptr || errno != EEXIST) return {name, file};
  }
}

bool is_written(std::FILE* file, std::string_view text) {
  const bool is_complete = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  return std::fclose(file) == 0 && is_complete;
}

}  // namespace

void write_atomically(std::string_view text, const std::filesystem::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw std::runtime_error(path.string() + ": cannot be written, allowed a regular file");
  }
  const auto [temporary, file] = new_file_beside(path);
  if (file != nullptr) {
    if (is_written(file, text)) {
      fs::rename(temporary, path, error);
      if (!error) return;
    }
    fs::remove(temporary, error);
  }
  throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace hlc
