#pragma once

#include <sys/types.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hlc::render {

/// A program that draws is missing or failed: one line.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program by its name in PATH; empty: there is none.
[[nodiscard]] std::string path_of(const std::string& program);

/// @param package  of Debian, for the message
/// @throws Fault if there is none
[[nodiscard]] std::string needed_path_of(const std::string& program, const std::string& package);

/// An open file, closed with this object and in every program that is started.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  void close();
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

struct Pipe {
  Descriptor out;  ///< to read
  Descriptor in;   ///< to write
};
/// @throws std::system_error
[[nodiscard]] Pipe make_pipe();

/// @throws std::system_error
[[nodiscard]] Descriptor open_file(const std::filesystem::path& file, int flags);

/// @throws Fault if the reader has gone. @pre SIGPIPE is ignored
void write_all(const Descriptor& file, std::string_view bytes);

/// A program in a process group of its own. Whatever is left of it ends with this object, and the
/// program itself with the thread that started it, however that ends.
class ChildProcess {
 public:
  /// @param arguments  program, as a path, and its flags
  /// @param files      that the program has open as 0, 1, 2 ...
  /// @throws std::system_error
  ChildProcess(const std::vector<std::string>& arguments, const std::vector<int>& files);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for its end. @return whether it ended with exit code 0. @pre called once
  [[nodiscard]] bool is_good_at_end();

 private:
  pid_t pid_;
  bool has_ended_{};
};

/// The last line that a program has written into its log, or "no message".
[[nodiscard]] std::string last_line_of(const std::filesystem::path& log);

}  // namespace hlc::render
