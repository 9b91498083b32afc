#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>

#include "tests/support/folders.hpp"

namespace hlc::test {

struct Outcome {
  int exit_code{};
  std::string output;  ///< of both streams
};

/// Runs a command of the shell to its end.
inline Outcome run_command(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  Outcome outcome;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    outcome.output += buffer.data();
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// Runs a program of this build to its end.
/// @param command  name and flags, as for a shell
/// @param before   commands of the shell before it: "ulimit -f 32; "
inline Outcome run_program(const std::string& command, const std::string& before = "") {
  return run_command(before + test::build_folder() + "/bin/" + command);
}

/// Lines that are longer and could be broken: behind their indent they have a blank.
inline std::string lines_beyond(std::size_t columns, const std::string& text) {
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    if (line.size() > columns && line.find(' ', first) != std::string::npos) found += line + '\n';
  }
  return found;
}

}  // namespace hlc::test
