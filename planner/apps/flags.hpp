#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/apps/cli.hpp"
#include "planner/apps/former_names.hpp"
#include "planner/apps/help.hpp"
#include "planner/apps/scenario_name.hpp"
#include "planner/common/program_version.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/priority_values.hpp"
#include "planner/scenario/scenario.hpp"

/// Common to the command lines of all programs: `--name=value` and `--name value`, `--help` and
/// `--version`, unknown flags refused, one line and exit code 2 for bad ones. What the help of
/// every program and script must hold, and which names mean the same everywhere, is tested by
/// tests/house/command_lines_test.cpp.
namespace hlc::apps {

/// Prints an error in one line, even if names of files and keys in it contain line breaks.
inline void complain(const std::string& program, const std::string& message) {
  std::cerr << program << ": " << escaped(message) << '\n';
}

/// Standard output is buffered: write errors show only here.
/// @throws std::runtime_error if some output could not be written
inline void flush_standard_output() {
  errno = 0;
  const bool is_flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  if (is_flushed && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw std::runtime_error("standard output: cannot be written" +
                           (reason == 0 ? "" : ": " + std::generic_category().message(reason)));
}

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

/// For flags of that type, without further bounds: CLI11 would not describe the good values.
template <class Type>
[[nodiscard]] CLI::Validator of_type(const std::string& allowed) {
  const auto is_good = [](const std::string& text) {
    Type value{};
    return CLI::detail::lexical_cast(text, value);
  };
  return allowing(is_good, allowed, "");
}

/// For flags with numbers: min <= x <= max, and neither infinite nor NaN, which CLI::Range accepts.
inline CLI::Validator within(double min, double max) {
  const bool is_bounded = std::isfinite(min) && std::isfinite(max);
  const std::string shown =
      is_bounded ? shortest_text(min) + " ... " + shortest_text(max) : "a finite number";
  const auto is_good = [min, max](const std::string& text) {
    double value{};
    return CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= min &&
           value <= max;
  };
  return allowing(is_good, (is_bounded ? "in " : "") + shown, shown);
}

/// The number, if the text is digits only and the number in min ... max.
inline std::optional<std::uint64_t> whole_number(std::string_view text, std::uint64_t min,
                                                 std::uint64_t max) {
  std::uint64_t value{};
  const char* const end = text.data() + text.size();
  const auto [read_until, error] = std::from_chars(text.data(), end, value);
  const bool is_good = error == std::errc{} && read_until == end && value >= min && value <= max;
  return is_good ? std::optional(value) : std::nullopt;
}

/// Two of them in 1 ... max with a character between them, as "4x3".
inline std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers(
    std::string_view text, char between, std::uint64_t max) {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const auto first = whole_number(text.substr(0, at), 1, max);
  const auto second = whole_number(text.substr(at + 1), 1, max);
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

/// For flags with whole numbers: digits only. CLI11 converts "-5" to a large unsigned number, and a
/// number that is too large to the largest.
inline CLI::Validator whole(std::uint64_t min, std::uint64_t max) {
  const std::string shown = fmt::format("{} ... {}", min, max);
  const auto is_good = [min, max](const std::string& text) {
    return whole_number(text, min, max).has_value();
  };
  return allowing(is_good, "in " + shown, shown);
}

/// The same for every finite number.
inline CLI::Validator finite() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return within(-kInfinity, kInfinity);
}

/// For flags with names.
inline CLI::Validator among(const std::vector<std::string>& names) {
  const std::string shown = fmt::format("{}", fmt::join(names, ", "));
  const auto is_good = [names](const std::string& text) {
    return std::ranges::find(names, text) != names.end();
  };
  return allowing(is_good, "one of " + shown, shown);
}

/// Checks of the type alone, after the flag's own checks.
inline void check_types(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    const std::string type = option->get_type_name();
    if (type.starts_with("BOOLEAN")) option->check(of_type<bool>("true or false"));
    if (type.starts_with("INT")) option->check(of_type<int>("a whole number"));
    if (type.starts_with("UINT")) option->check(of_type<std::uint64_t>("a whole number"));
    if (type.starts_with("FLOAT")) option->check(of_type<double>("a number"));
  }
}

inline int refuse_unknown(const CLI::App& app, const CLI::ExtrasError& error) {
  complain(app.get_name(), std::string(error.what()) + ", must be a flag that --help lists");
  return 2;
}

/// Nothing if the flags are good; otherwise the exit code: 0 after the help or the version, 2 after
/// one line about the bad flag, or about a help that could not be printed.
/// @param former  names of flags up to the last release
inline std::optional<int> parse_flags(CLI::App& app, int argc, char** argv,
                                      const std::vector<FormerName>& former = {}) {
  check_types(app);
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag(
      "--version", app.get_name() + " " + program_release() + ", revision " + program_revision(),
      "Print the version and the revision of the sources, and exit");
  try {
    std::vector<std::string> arguments = with_present_names(app.get_name(), argc, argv, former);
    std::ranges::reverse(arguments);  // as CLI11 wants them
    app.parse(arguments);
    return std::nullopt;
  } catch (const CLI::Success& help) {
    const int code = app.exit(help);
    try {
      flush_standard_output();
      return code;
    } catch (const std::runtime_error& error) {
      complain(app.get_name(), error.what());
      return 2;
    }
  } catch (const CLI::ExtrasError& error) {
    return refuse_unknown(app, error);
  } catch (const CLI::ArgumentMismatch& error) {
    complain(app.get_name(), std::string(error.what()) + ", must have a value");
    return 2;
  } catch (const CLI::ParseError& error) {
    complain(app.get_name(), error.what());
    return 2;
  }
}

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
inline CLI::Option* declare_scenario(CLI::App& app, const std::string& name,
                                     std::filesystem::path& file, const std::string& more = "") {
  return takes_scenario(app.add_option(
      name, file, "file (YAML), or the name of one of launch_scripts/scenarios" + more));
}

/// The run folder, with the flag or without.
inline void declare_run(CLI::App& app, std::filesystem::path& run) {
  app.add_option("RUN,--run", run, "run folder")->required()->type_name("DIR");
}

/// The flags that choose a scenario.
inline void declare_scenario_flags(CLI::App& app, scenario::ScenarioChoices& choices) {
  declare_scenario(app, "--scenario", choices.file)->required();
  declare_profile_flag(app, choices.profile);
  app.add_option("--engine", choices.engine,
                 "search engine: " + scenario::engine_choices() +
                     " (default: the scenario's, else the profile's)");
  app.add_option(
         "--priorities", choices.priorities,
         "who plans first (default: the scenario's): " + scenario::priority_strategies_text())
      ->check(among(coordination::priority_strategy_names()));
  app.add_option("--subgraph", choices.subgraph, "instead of the scenario's");
  app.add_option("--policy", choices.policy,
                 "by which the controllers change the subgraph themselves, or none (default: the "
                 "scenario's)");
  app.add_option("--map", choices.map_file, "CommonRoad XML instead of the scenario's")
      ->type_name("FILE");
  app.add_option("--cars", choices.cars,
                 "number of cars (scenarios on a circle, or that draw their cars), instead of the "
                 "scenario's")
      ->check(whole(1, kMaxVehicleId));
  app.add_option("--seed", choices.seed,
                 "of drawn cars and random routes (default: the scenario's)")
      ->check(whole(0, scenario::kMaxSeed));
  app.add_option("--routes", choices.routes,
                 "random: every car takes random turns forever, instead of the scenario's routes")
      ->check(among({scenario::kRandomRoutes}));
}

}  // namespace hlc::apps
