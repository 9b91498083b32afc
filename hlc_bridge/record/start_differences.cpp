#include "hlc_bridge/record/start_differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::record {
namespace {

namespace fs = std::filesystem;

using Flags = std::map<std::string, std::string>;

constexpr char kNone[] = "null";

/// With the keys that are null; without files, whose text counts, too.
Flags flags_of(const fs::path& folder) {
  const Node file = Node::read_yaml(folder / "configuration" / "flags.yaml");
  Flags flags;
  for (const std::string& key : file.keys()) {
    if (key == "scenario" || key == "map" || key == "dds_domain") continue;
    flags[key] = file.is_value(key) ? file.required<std::string>(key) : kNone;
  }
  std::vector<std::string> forks;
  for (const KeptFork& fork : kept_forks(folder)) {
    forks.push_back(fmt::format("from step {} {}", fork.from, fmt::join(fork.set, " ")));
  }
  if (!forks.empty()) flags["forks"] = fmt::format("{}", fmt::join(forks, ", "));
  return flags;
}

std::string value_of(const Flags& flags, const std::string& key) {
  const auto found = flags.find(key);
  return found == flags.end() ? kNone : found->second;
}

/// From 1. @pre the texts differ
std::size_t first_line_that_differs(const std::string& a, const std::string& b) {
  const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return 1 + static_cast<std::size_t>(std::count(a.begin(), end, '\n'));
}

/// Nothing: the same name and text.
std::optional<std::string> file_difference(const std::string& what,
                                           const std::optional<fs::path>& a,
                                           const std::optional<fs::path>& b) {
  if (!a && !b) return std::nullopt;
  const auto name_of = [](const std::optional<fs::path>& file) {
    return file ? one_line(file->filename().string()) : kNone;
  };
  if (!a || !b) return fmt::format("{}: {} and {}", what, name_of(a), name_of(b));
  const std::string text_a = read_file(*a);
  const std::string text_b = read_file(*b);
  const bool has_same_text = text_a == text_b;
  if (name_of(a) != name_of(b)) {
    return fmt::format("{}: {} and {}{}", what, name_of(a), name_of(b),
                       has_same_text ? ", with the same text" : "");
  }
  if (has_same_text) return std::nullopt;
  return fmt::format("{} {}: other text from line {} on", what, name_of(a),
                     first_line_that_differs(text_a, text_b));
}

}  // namespace

std::vector<std::string> start_differences(const RunFolder& a, const RunFolder& b) {
  std::vector<std::string> lines;
  const auto compare_files = [&](const char* what, const auto& file_a, const auto& file_b) {
    if (auto line = file_difference(what, file_a, file_b)) lines.push_back(*std::move(line));
  };
  compare_files("scenario", a.scenario.file, b.scenario.file);
  compare_files("automaton", a.scenario.automaton_file, b.scenario.automaton_file);
  compare_files("map", a.scenario.map_file, b.scenario.map_file);
  compare_files("lab", a.scenario.lab_file, b.scenario.lab_file);
  const Flags flags_a = flags_of(a.folder);
  const Flags flags_b = flags_of(b.folder);
  Flags all = flags_a;
  all.insert(flags_b.begin(), flags_b.end());
  for (const auto& [key, value] : all) {
    const std::string in_a = value_of(flags_a, key);
    const std::string in_b = value_of(flags_b, key);
    if (in_a == in_b) continue;
    lines.push_back(
        fmt::format("{}: {} and {}", one_line(key), one_line(in_a, 200), one_line(in_b, 200)));
  }
  return lines;
}

}  // namespace hlc::record
