#pragma once

#include <set>
#include <string>
#include <vector>

namespace hlc::test {

/// What a flag takes, whatever a help calls it: UINT and INT, or N in a script, are whole numbers.
enum class ValueKind { kNone, kBoolean, kWhole, kNumber, kText, kPath };

/// A flag of a --help.
struct HelpFlag {
  std::vector<std::string> names;  ///< with their dashes; at least one
  std::string value;               ///< its type, range and default as shown; empty: takes none
  std::string description;

  [[nodiscard]] ValueKind kind() const;
};

/// The --help of a program or script, taken apart.
struct CommandHelp {
  std::string command;  ///< as it is called from the folder of the programs
  std::string name;     ///< "rollout", "run_lab.sh"
  bool is_program{};    ///< made by planner/apps/flags.hpp
  std::string text;
  std::vector<HelpFlag> flags;  ///< without --help and --version
  std::vector<std::string> examples;
};

/// @param command  name of a program, or a script's path from the folder of the programs
[[nodiscard]] CommandHelp read_help(const std::string& command);

/// Of all programs, and of all scripts that are run (others are parts of these).
[[nodiscard]] std::vector<std::string> all_commands();

/// The long flags in a command line.
[[nodiscard]] std::set<std::string> flags_in(const std::string& command_line);

}  // namespace hlc::test
