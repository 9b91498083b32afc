#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/apps/cli.hpp"
#include "planner/apps/former_names.hpp"
#include "planner/apps/help.hpp"
#include "planner/common/yaml_text.hpp"

/// Common to the command lines of all programs: `--name=value` and `--name value`, `--help` and
/// `--version`, unknown flags refused, one line and exit code 2 for bad ones. What the help of
/// every program and script must hold, and which names mean the same everywhere, is tested by
/// tests/house/command_lines_test.cpp.
namespace hlc::apps {

/// The App of every program. All of CLI11 is inline; as this class is constructed, destroyed and
/// parsed in its own file, which has the virtual functions then, the other files compile only the
/// templates that declare their flags.
class CommandLine : public CLI::App {
 public:
  CommandLine(std::string description, std::string name);
  ~CommandLine() override;
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
};

/// Prints an error in one line, even if names of files and keys in it contain line breaks.
void complain(const std::string& program, const std::string& message);

/// Standard output is buffered: write errors show only here.
/// @throws std::runtime_error if some output could not be written
void flush_standard_output();

/// A validator from a predicate and the description of good values.
/// @param shown  in the help, beside the flag's type; empty: nothing
template <class IsGood>
[[nodiscard]] CLI::Validator allowing(IsGood is_good, const std::string& allowed,
                                      const std::string& shown) {
  return CLI::Validator(
      [is_good, allowed](std::string& text) {
        return is_good(text) ? std::string{} : one_line(text) + ", must be " + allowed;
      },
      shown);
}

/// For flags with numbers: min <= x <= max, and neither infinite nor NaN, which CLI::Range accepts.
[[nodiscard]] CLI::Validator within(double min, double max);

/// The number, if the text is digits only and the number in min ... max.
[[nodiscard]] std::optional<std::uint64_t> whole_number(std::string_view text, std::uint64_t min,
                                                        std::uint64_t max);

/// Two of them in 1 ... max with a character between them, as "4x3".
[[nodiscard]] std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers(
    std::string_view text, char between, std::uint64_t max);

/// For flags with whole numbers: digits only. CLI11 converts "-5" to a large unsigned number, and a
/// number that is too large to the largest.
[[nodiscard]] CLI::Validator whole(std::uint64_t min, std::uint64_t max);

/// The same for every finite number.
[[nodiscard]] CLI::Validator finite();

/// For flags with names.
[[nodiscard]] CLI::Validator among(const std::vector<std::string>& names);

[[nodiscard]] int refuse_unknown(const CLI::App& app, const CLI::ExtrasError& error);

/// Nothing if the flags are good; otherwise the exit code: 0 after the help or the version, 2 after
/// one line about the bad flag, or about a help that could not be printed.
/// @param former  names of flags up to the last release
[[nodiscard]] std::optional<int> parse_flags(CommandLine& app, int argc, char** argv,
                                             const std::vector<FormerName>& former = {});

/// Runs the program's work, which returns nothing or an exit code. Returns that code, or 0, if the
/// work succeeds and all its output is written; 2 after one line about invalid input
/// (std::invalid_argument) or any other error: an output that cannot be written.
template <class Work>
int exit_code_of(const char* program, Work work) {
  try {
    int code = 0;
    if constexpr (std::is_void_v<decltype(work())>) {
      work();
    } else {
      code = work();
    }
    flush_standard_output();
    return code;
  } catch (const std::exception& error) {
    complain(program, error.what());
    return 2;
  }
}

/// @throws std::invalid_argument naming the flag for a duplicate value
template <class Value>
void check_each_once(const std::string& flag, const std::vector<Value>& values) {
  for (auto value = values.begin(); value != values.end(); ++value) {
    if (std::find(values.begin(), value, *value) == value) continue;
    throw std::invalid_argument(fmt::format("{} = {} twice, must be unique", flag, *value));
  }
}

/// For a profile, or a list of them.
template <class Profiles>
CLI::Option* declare_profile_flag(CLI::App& app, Profiles& profiles) {
  return app.add_option("--profile", profiles, "rules for planning and coordination")
      ->check(among({"default", "2022"}))
      ->capture_default_str();
}

/// Also as a positional, "SCENARIO,--scenario".
/// @param more  behind what the flag is
CLI::Option* declare_scenario(CLI::App& app, const std::string& name, std::filesystem::path& file,
                              const std::string& more = "");

/// The run folder, with the flag or without.
void declare_run(CLI::App& app, std::filesystem::path& run);

}  // namespace hlc::apps
