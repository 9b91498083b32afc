#include "planner/apps/scenario_name.hpp"

#include <fmt/format.h>

#include <set>

#include "planner/common/yaml_text.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml") names.insert(entry.path().stem());
  }
  return names;
}

/// Replaces the text by the file. @return what is wrong; empty: nothing
std::string replace_by_file(std::string& text) {
  const fs::path file = scenario_named(text, shipped_scenarios());
  const bool is_name = !text.empty() && file != fs::path(text);
  if (is_name && !fs::is_regular_file(file)) {
    return fmt::format("{}, must be a file, or one of {} in {}", one_line(text),
                       fmt::join(names_in(shipped_scenarios()), ", "),
                       shipped_scenarios().string());
  }
  text = file.string();
  return "";
}

}  // namespace

fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path shipped_scenarios() { return program_folder() / "scenarios"; }

fs::path scenario_named(const std::string& file_or_name, const fs::path& folder) {
  const fs::path given = file_or_name;
  if (given.empty() || fs::is_regular_file(given) || given.has_extension()) return given;
  return folder / (file_or_name + ".yaml");
}

CLI::Option* takes_scenario(CLI::Option* option) {
  return option->type_name("SCENARIO")->transform(CLI::Validator(&replace_by_file, ""));
}

}  // namespace hlc::apps
