#pragma once

#include <string>
#include <vector>

namespace hlc {

/// Runs a program to its end, with the input, output and errors of this one. Prints one line on
/// stderr if it cannot be started.
/// @param command  the program's file, then its arguments
/// @return true if its exit code is 0
[[nodiscard]] bool run_program(std::vector<std::string> command);

}  // namespace hlc
