#include "planner/apps/flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "planner/apps/scenario_name.hpp"
#include "planner/common/program_version.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::apps {
namespace {

/// For flags of that type, without further bounds: CLI11 would not describe the good values.
template <class Type>
CLI::Validator of_type(const std::string& allowed) {
  const auto is_good = [](const std::string& text) {
    Type value{};
    return CLI::detail::lexical_cast(text, value);
  };
  return allowing(is_good, allowed, "");
}

/// Checks of the type alone, after the flag's own checks.
void check_types(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; })) {
    const std::string type = option->get_type_name();
    if (type.starts_with("BOOLEAN")) option->check(of_type<bool>("true or false"));
    if (type.starts_with("INT")) option->check(of_type<int>("a whole number"));
    if (type.starts_with("UINT")) option->check(of_type<std::uint64_t>("a whole number"));
    if (type.starts_with("FLOAT")) option->check(of_type<double>("a number"));
  }
}

}  // namespace

CommandLine::CommandLine(std::string description, std::string name)
    : CLI::App(std::move(description), std::move(name)) {}
CommandLine::~CommandLine() = default;

void complain(const std::string& program, const std::string& message) {
  std::cerr << program << ": " << escaped(message) << '\n';
}

void flush_standard_output() {
  errno = 0;
  const bool is_flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  if (is_flushed && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw std::runtime_error("standard output: cannot be written" +
                           (reason == 0 ? "" : ": " + std::generic_category().message(reason)));
}

CLI::Validator within(double min, double max) {
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

std::optional<std::uint64_t> whole_number(std::string_view text, std::uint64_t min,
                                          std::uint64_t max) {
  std::uint64_t value{};
  const char* const end = text.data() + text.size();
  const auto [read_until, error] = std::from_chars(text.data(), end, value);
  const bool is_good = error == std::errc{} && read_until == end && value >= min && value <= max;
  return is_good ? std::optional(value) : std::nullopt;
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> two_whole_numbers(std::string_view text,
                                                                         char between,
                                                                         std::uint64_t max) {
  const std::size_t at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const auto first = whole_number(text.substr(0, at), 1, max);
  const auto second = whole_number(text.substr(at + 1), 1, max);
  return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

CLI::Validator whole(std::uint64_t min, std::uint64_t max) {
  const std::string shown = fmt::format("{} ... {}", min, max);
  const auto is_good = [min, max](const std::string& text) {
    return whole_number(text, min, max).has_value();
  };
  return allowing(is_good, "in " + shown, shown);
}

CLI::Validator finite() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return within(-kInfinity, kInfinity);
}

CLI::Validator among(const std::vector<std::string>& names) {
  const std::string shown = fmt::format("{}", fmt::join(names, ", "));
  const auto is_good = [names](const std::string& text) {
    return std::ranges::find(names, text) != names.end();
  };
  return allowing(is_good, "one of " + shown, shown);
}

int refuse_unknown(const CLI::App& app, const CLI::ExtrasError& error) {
  complain(app.get_name(), std::string(error.what()) + ", must be a flag that --help lists");
  return 2;
}

std::optional<int> parse_flags(CommandLine& app, int argc, char** argv,
                               const std::vector<FormerName>& former) {
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

CLI::Option* declare_scenario(CLI::App& app, const std::string& name, std::filesystem::path& file,
                              const std::string& more) {
  return takes_scenario(app.add_option(
      name, file, "file (YAML), or the name of one of launch_scripts/scenarios" + more));
}

void declare_run(CLI::App& app, std::filesystem::path& run) {
  app.add_option("RUN,--run", run, "run folder")->required()->type_name("DIR");
}

}  // namespace hlc::apps
