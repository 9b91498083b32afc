#include "planner/apps/help.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "planner/apps/terminal.hpp"

namespace hlc::apps {
namespace {

constexpr std::size_t kNameColumns = 30;
constexpr std::size_t kNarrow = 70;  ///< a description begins below its flag
constexpr std::size_t kNarrowIndent = 6;
constexpr std::size_t kMostExcluded = 1;

std::size_t columns() { return columns_of(STDOUT_FILENO); }

/// CLI11 keeps them in the order of their addresses.
std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return names;
}

}  // namespace

void declare_help_end(CLI::App& app, const HelpEnd& end) {
  std::string text = end.notes.empty() ? "" : end.notes + '\n';
  text += "Examples:\n";
  for (const std::string& example : end.examples) text += "  " + example + '\n';
  app.footer(text + "Exit codes: " + end.exit_codes + '.');
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), columns(), 0);
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  return wrapped(app->get_footer(), columns(), 0);
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string name =
      "  " + make_option_name(option, is_positional) + make_option_opts(option);
  const std::string description = make_option_desc(option);
  if (columns() < kNarrow) {
    return "  " + wrapped(name.substr(2), columns() - 2, 0) +
           wrapped(description, columns(), kNarrowIndent);
  }
  const std::string text = wrapped(description, columns(), kNameColumns);
  if (name.size() + 1 < kNameColumns && !text.empty()) {
    return name + text.substr(name.size());
  }
  const std::string head = wrapped(name.substr(2), columns(), kNarrowIndent);
  return "  " + head.substr(kNarrowIndent) + text;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0) return "";
  std::string text = ' ' + option->get_type_name();
  if (!option->get_default_str().empty()) text += '=' + option->get_default_str();
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size) {
    text += " ...";
  } else if (option->get_expected_min() > 1) {
    text += fmt::format(" x {}", option->get_expected_min());
  }
  if (option->get_required()) text += " REQUIRED";
  return text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (!option->get_envname().empty()) {
    add("also by the environment variable " + option->get_envname());
  }
  const std::vector<std::string> needed = names_of(option->get_needs());
  if (!needed.empty()) add(fmt::format("only with {}", fmt::join(needed, ", ")));
  const std::vector<std::string> excluded = names_of(option->get_excludes());
  if (!excluded.empty() && excluded.size() <= kMostExcluded) {
    add(fmt::format("not with {}", fmt::join(excluded, ", ")));
  }
  return text;
}

}  // namespace hlc::apps
