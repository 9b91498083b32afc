#include "planner/common/growing_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/common/text_file.hpp"

namespace hlc {
namespace {

int flags_of(GrowingFile::Opening opening) {
  if (opening == GrowingFile::Opening::kNew) return O_EXCL;
  return opening == GrowingFile::Opening::kEmptied ? O_TRUNC : O_APPEND;
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw std::system_error(error, std::generic_category(), file.string() + ": cannot be written");
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path file, Opening opening, OnFailure on_failure)
    : path_(std::move(file)), on_failure_(std::move(on_failure)) {
  constexpr mode_t kAsTheUserWants = 0666;  // less the umask
  descriptor_ =
      ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags_of(opening), kAsTheUserWants);
  if (descriptor_ < 0) refuse(path_, errno);
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : path_(std::move(other.path_)),
      on_failure_(std::move(other.on_failure_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      missing_(other.missing_),
      has_failed_(other.has_failed_) {}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int GrowingFile::append(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  // A removed file takes everything and keeps nothing.
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) return errno;
  return status.st_nlink == 0 ? ENOENT : 0;
}

void GrowingFile::begin(std::string_view heading) {
  if (const int error = append(heading)) refuse(path_, error);
}

void GrowingFile::write(std::string_view text) {
  const int error = has_failed_ ? 0 : append(text);
  if (error != 0 || has_failed_) ++missing_;
  if (error != 0) fail(std::generic_category().message(error));
}

void GrowingFile::fail(const std::string& reason) {
  report(fmt::format("{}: no longer written: {}", path_.string(), reason));
}

void GrowingFile::report(const std::string& line) {
  if (!std::exchange(has_failed_, true)) on_failure_(line);
}

void GrowingFile::replace(std::string_view text) {
  ::close(std::exchange(descriptor_, -1));
  try {
    write_file(path_, text);
    has_failed_ = false;
  } catch (const std::runtime_error& error) {
    report(error.what());
  }
}

std::optional<std::string> GrowingFile::close() {
  // Removed after the last row, or a file system that reports a full disk only now.
  if (descriptor_ >= 0) {
    const int removed = append({});
    const int error = ::close(std::exchange(descriptor_, -1)) != 0 ? errno : removed;
    if (error != 0) fail(std::generic_category().message(error));
  }
  if (!has_failed_) return std::nullopt;
  return fmt::format("{}: incomplete{}", path_.string(),
                     missing_ == 0 ? "" : fmt::format(", {} rows are missing", missing_));
}

}  // namespace hlc
