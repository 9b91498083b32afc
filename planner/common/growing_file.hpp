#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace hlc {

/// A record that grows while cars drive, such as one row per tick. It is no reason to stop driving:
/// the first failure (full disk, quota, file removed) is reported once, and from then on rows
/// are counted and dropped, since what follows an incomplete row could not be read.
///
/// Nothing is buffered: a text has reached the system when `write` returns, also if the process is
/// killed then. For one thread.
class GrowingFile {
 public:
  enum class Opening { kNew, kEmptied, kContinued };  ///< kNew: the file must not exist
  /// Called once at most, within one of the functions below, with a line for the log that names
  /// file and reason. It may throw.
  using OnFailure = std::function<void(const std::string& line)>;

  /// @throws std::system_error naming the file if it cannot be opened
  GrowingFile(std::filesystem::path file, Opening opening, OnFailure on_failure);
  ~GrowingFile();
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;
  GrowingFile& operator=(GrowingFile&&) = delete;

  /// Writes the text with which the file begins. @throws std::system_error naming the file
  void begin(std::string_view heading);
  /// Appends a row.
  void write(std::string_view text);
  /// As if writing had failed for this reason; without effect after a failure.
  void fail(const std::string& reason);
  /// Writes the file once more, whole (`write_file`), and closes it: then nothing is missing,
  /// whatever failed before.
  void replace(std::string_view text);

  /// Nothing can be written afterwards. Empty if the file is complete; else a line for the log with
  /// the number of rows that are missing, the same at every call.
  std::optional<std::string> close();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] bool has_failed() const { return has_failed_; }

 private:
  /// @return errno, 0: all is written
  [[nodiscard]] int append(std::string_view text) const;
  void report(const std::string& line);

  std::filesystem::path path_;
  OnFailure on_failure_;
  int descriptor_{-1};  ///< -1: closed
  std::size_t missing_{};
  bool has_failed_{};
};

}  // namespace hlc
