#include "planner/common/text_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace hlc {
namespace {

namespace fs = std::filesystem;

/// A new file beside `path`, opened for writing; null if that fails. No other process and no other
/// thread uses it, and no existing file is reused.
std::pair<fs::path, std::FILE*> new_file_beside(const fs::path& path) {
  for (int number = 0;; ++number) {
    fs::path name = path;
    name += fmt::format(".{}_{}.part", getpid(), number);
    std::FILE* const file = std::fopen(name.c_str(), "wbx");
    if (file != nullptr || errno != EEXIST) return {name, file};
  }
}

bool is_written(std::FILE* file, std::string_view text) {
  const bool is_complete = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  return std::fclose(file) == 0 && is_complete;
}

}  // namespace

void write_file(const fs::path& path, std::string_view text) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw std::runtime_error(path.string() + ": cannot be written, must be a regular file");
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

std::string read_file(const fs::path& path) {
  std::ifstream stream{path, std::ios::binary};
  std::string text{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream || stream.bad()) throw std::runtime_error(path.string() + ": cannot be read");
  return text;
}

std::string read_regular_file(const fs::path& path, std::string_view allowed) {
  std::error_code error;
  try {
    if (fs::is_regular_file(path, error)) return read_file(path);
  } catch (const std::runtime_error&) {
    // The same message for every cause.
  }
  throw std::invalid_argument(
      fmt::format("{}: cannot be read, must be {}", path.string(), allowed));
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || text[i] == separator) {
      pieces.emplace_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  return pieces;
}

}  // namespace hlc
