#include "tests/house/command_help.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// Columns of a help that is read here.
constexpr const char* kColumns = "COLUMNS=100 ";

constexpr std::size_t kIndent =
    6;  ///< of the second line of a flag's value; descriptions have more

/// "  --name,--other TYPE  description", or nothing behind the names.
bool begins_flag(const std::string& line) {
  static const std::regex kFlag("^  (-h, ?)?--?[a-z].*");
  return std::regex_match(line, kFlag);
}

HelpFlag flag_of(const std::string& line) {
  static const std::regex kName("^(, ?)?(--?[A-Za-z_][A-Za-z_0-9-]*)");
  HelpFlag flag;
  std::string rest = line.substr(2);
  for (std::smatch match; std::regex_search(rest, match, kName);) {
    flag.names.push_back(match[2]);
    rest = match.suffix();
  }
  // The value begins after one blank, a description after two and more.
  if (rest.starts_with(" ") && !rest.starts_with("  ")) {
    const std::size_t end = rest.find("  ", 1);
    flag.value = rest.substr(1, end == std::string::npos ? end : end - 1);
    rest = end == std::string::npos ? "" : rest.substr(end);
  }
  flag.description = rest;
  return flag;
}

bool is_own(const HelpFlag& flag) {
  return flag.names.back() != "--help" && flag.names.back() != "--version";
}

/// Of the script, or an empty text.
std::string script_path(const std::string& from_root) {
  const fs::path bin = fs::path(build_folder()) / "bin";
  return (fs::path(source_folder()) / from_root).lexically_relative(bin);
}

}  // namespace

ValueKind HelpFlag::kind() const {
  static const std::map<std::string, ValueKind> kKinds{
      {"BOOLEAN", ValueKind::kBoolean}, {"BOOL", ValueKind::kBoolean},
      {"INT", ValueKind::kWhole},       {"UINT", ValueKind::kWhole},
      {"N", ValueKind::kWhole},         {"FLOAT", ValueKind::kNumber},
      {"X", ValueKind::kNumber},        {"FILE", ValueKind::kPath},
      {"DIR", ValueKind::kPath},        {"SCENARIO", ValueKind::kPath}};
  if (value.empty()) return ValueKind::kNone;
  const auto found =
      kKinds.find(value.substr(0, value.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ")));
  return found == kKinds.end() ? ValueKind::kText : found->second;
}

CommandHelp read_help(const std::string& command) {
  CommandHelp help{.command = command,
                   .name = fs::path(command).filename(),
                   .is_program = command.find('/') == std::string::npos,
                   .text = run_program(command + " --help", kColumns).output,
                   .flags = {},
                   .examples = {}};
  std::istringstream lines(help.text);
  bool in_examples = false;
  std::vector<HelpFlag> flags;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Examples:") in_examples = true;
    if (line.starts_with("Exit codes")) in_examples = false;
    if (in_examples && line.starts_with("  ")) {
      help.examples.push_back(line.substr(2));
    } else if (begins_flag(line)) {
      flags.push_back(flag_of(line));
    } else if (line.starts_with(std::string(kIndent, ' ')) && !flags.empty()) {
      const bool continues_value = help.is_program && line[kIndent] != ' ';
      (continues_value ? flags.back().value : flags.back().description) += ' ' + line;
    }
  }
  std::ranges::copy_if(flags, std::back_inserter(help.flags), &is_own);
  return help;
}

std::vector<std::string> all_commands() {
  std::vector<std::string> all;
  std::istringstream programs(HLC_PROGRAMS);
  for (std::string name; programs >> name;) all.push_back(name);
  for (const auto& entry : fs::directory_iterator(fs::path(source_folder()) / "launch_scripts")) {
    const bool is_run = (entry.status().permissions() & fs::perms::owner_exec) != fs::perms::none;
    if (entry.is_regular_file() && is_run) {
      all.push_back(script_path("launch_scripts/" + entry.path().filename().string()));
    }
  }
  for (const char* const script : {"launch_scripts/course/check.py", "tests/verify/verify.sh",
                                   "tests/fuzz/run.sh", "vehicle_sim/report/documents.sh",
                                   "vehicle_sim/report/draw.sh", "vehicle_sim/report/report.sh"}) {
    all.push_back(script_path(script));
  }
  return all;
}

std::set<std::string> flags_in(const std::string& command_line) {
  static const std::regex kFlag("(^|\\s)(--[A-Za-z_][A-Za-z_0-9-]*)");
  std::set<std::string> flags;
  for (std::sregex_iterator one(command_line.begin(), command_line.end(), kFlag), end; one != end;
       ++one) {
    flags.insert((*one)[2]);
  }
  return flags;
}

}  // namespace hlc::test
