#include "planner/common/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
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

/// @return errno, 0: all is written
int write_and_close(std::FILE* file, std::string_view text) {
  const bool is_complete = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int error = is_complete ? 0 : errno;
  return std::fclose(file) != 0 && is_complete ? errno : error;
}

struct Descriptor {
  explicit Descriptor(const fs::path& path)
      : value(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int value;
};

std::string read_bounded(const fs::path& path, std::string_view allowed, std::size_t most_bytes) {
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error(path.string() + ": " + reason);
  };
  const auto check_size = [&](std::size_t bytes) {
    if (bytes > most_bytes) fail(fmt::format("{} bytes, must be <= {}", bytes, most_bytes));
  };
  const std::string unreadable = fmt::format("cannot be read, must be {}", allowed);
  const Descriptor file(path);
  struct stat status {};
  if (file.value < 0 || ::fstat(file.value, &status) != 0 || !S_ISREG(status.st_mode)) {
    fail(unreadable);
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  check_size(size);
  // Files of /proc have no size, and others may grow.
  constexpr std::size_t kPiece = std::size_t{1} << 16U;
  std::string text;
  text.reserve(size + kPiece);  // the last read, of nothing, must not make it longer
  while (true) {
    const std::size_t begin = text.size();
    text.resize(std::max(text.capacity(), begin + kPiece));
    const ssize_t count = ::read(file.value, text.data() + begin, text.size() - begin);
    if (count < 0) fail(unreadable);
    text.resize(begin + static_cast<std::size_t>(count));
    if (count == 0) return text;
    check_size(text.size());
  }
}

}  // namespace

void write_file(const fs::path& path, std::string_view text) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw std::runtime_error(path.string() + ": cannot be written, must be a regular file");
  }
  const auto [temporary, file] = new_file_beside(path);
  error.assign(file == nullptr ? errno : write_and_close(file, text), std::generic_category());
  if (!error) fs::rename(temporary, path, error);
  if (!error) return;
  std::error_code ignored;
  if (file != nullptr) fs::remove(temporary, ignored);
  throw std::system_error(error, path.string() + ": cannot be written");
}

std::string read_file(const fs::path& path, std::size_t most_bytes) {
  return read_bounded(path, "a regular file", most_bytes);
}

std::string read_regular_file(const fs::path& path, std::string_view allowed) {
  try {
    return read_bounded(path, allowed, kMostInputBytes);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
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
