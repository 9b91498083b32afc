// One command line for all programs and scripts: what every --help holds, and one name for one
// thing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/house/command_help.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {

// GoogleTest prints bytes otherwise.
void PrintTo(ValueKind kind, std::ostream* out) {
  *out << std::array{"none", "boolean", "whole number", "number", "text", "path"}.at(
      static_cast<std::size_t>(kind));
}

namespace {

/// Read once for all tests.
const std::vector<CommandHelp>& all_help() {
  static const std::vector<CommandHelp> kAll = [] {
    std::vector<CommandHelp> all;
    for (const std::string& command : all_commands()) all.push_back(read_help(command));
    return all;
  }();
  return kAll;
}

bool has(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex(pattern));
}

TEST(CommandLines, AreReadWithTheirFlags) {
  EXPECT_GE(all_help().size(), 35U);
  for (const CommandHelp& help : all_help()) {
    EXPECT_TRUE(has(help.text, "[Uu]sage: ")) << help.name << ": " << help.text;
  }
}

TEST(CommandLines, FlagsAreLowerCaseWithUnderscores) {
  for (const CommandHelp& help : all_help()) {
    for (const HelpFlag& flag : help.flags) {
      for (const std::string& name : flag.names) {
        EXPECT_TRUE(std::regex_match(name, std::regex("--[a-z][a-z0-9]*(_[a-z0-9]+)*")))
            << help.name << ' ' << name;
      }
    }
  }
}

/// What a flag is called everywhere instead.
const std::vector<std::pair<std::string, std::string>> kOtherNames{
    {"--config", "--configuration"},
    {"--cfg", "--configuration"},
    {"--vehicle", "--vehicle_id(s)"},
    {"--vehicles", "--vehicle_ids"},
    {"--id", "--vehicle_id(s)"},
    {"--ids", "--vehicle_ids"},
    {"--dump", "--dump_problems"},
    {"--problem_folder", "--dump_problems"},
    {"--rows", "--table"},
    {"--csv", "--table"},
    {"--seconds", "--time_s"},
    {"--strategies", "--priorities"},
    {"--criterion", "--criteria"},
    {"--output", "--out"},
    {"--threads", "--jobs"},
    {"--domain", "--dds_domain"},
    {"--scenarios", "--scenario"},
    {"--run_folder", "--run"},
    {"--realtime", "--simulated_time"},
    {"--max_speed", "--max_speed_mps"},
    {"--verbose", "--log_level"},
    {"--log_file", "--log"}};

TEST(CommandLines, OneThingHasOneName) {
  for (const CommandHelp& help : all_help()) {
    for (const HelpFlag& flag : help.flags) {
      for (const auto& [other, name] : kOtherNames) {
        EXPECT_EQ(std::ranges::count(flag.names, other), 0)
            << help.name << ' ' << other << ", must be " << name;
      }
    }
  }
}

/// Whole numbers are numbers.
ValueKind kind_of(const HelpFlag& flag) {
  return flag.kind() == ValueKind::kWhole ? ValueKind::kNumber : flag.kind();
}

TEST(CommandLines, OneNameTakesOneKindOfValue) {
  // A search tree is written to a file, or into the folder of the run that is explained.
  const std::vector<std::string> exempt{"--tree"};
  std::map<std::string, std::pair<ValueKind, std::string>> first;
  for (const CommandHelp& help : all_help()) {
    for (const HelpFlag& flag : help.flags) {
      for (const std::string& name : flag.names) {
        if (std::ranges::find(exempt, name) != exempt.end()) continue;
        const auto [known, is_new] = first.try_emplace(name, kind_of(flag), help.name);
        EXPECT_EQ(known->second.first, kind_of(flag))
            << name << " of " << help.name << " and of " << known->second.second;
      }
    }
  }
}

TEST(CommandLines, FlagsAreExplainedWithTheirDefaults) {
  for (const CommandHelp& help : all_help()) {
    for (const HelpFlag& flag : help.flags) {
      const std::string place = help.name + ' ' + flag.names.front();
      EXPECT_TRUE(has(flag.description, "[a-z]{2}")) << place;
      const ValueKind kind = flag.kind();
      if (!help.is_program || kind == ValueKind::kNone || kind == ValueKind::kPath) continue;
      const bool has_default =
          has(flag.value, "=|REQUIRED") || has(flag.description, "default|instead of|required");
      EXPECT_TRUE(has_default) << place << ": " << flag.value << ' ' << flag.description;
    }
  }
}

TEST(CommandLines, NumbersHaveTheirUnits) {
  for (const CommandHelp& help : all_help()) {
    for (const HelpFlag& flag : help.flags) {
      if (!help.is_program || flag.kind() != ValueKind::kNumber) continue;
      const bool is_clear = has(flag.names.front(), "_(s|ms|m|mps|ns)$") ||
                            has(flag.description, "\\[[a-z]|factor|share");
      EXPECT_TRUE(is_clear) << help.name << ' ' << flag.names.front() << ": " << flag.description;
    }
  }
}

TEST(CommandLines, TwoExamplesUseFlagsThatThereAre) {
  for (const CommandHelp& help : all_help()) {
    EXPECT_GE(help.examples.size(), 2U) << help.name;
    std::vector<std::string> names;
    for (const HelpFlag& flag : help.flags) {
      names.insert(names.end(), flag.names.begin(), flag.names.end());
    }
    for (const std::string& example : help.examples) {
      EXPECT_TRUE((example + ' ').starts_with(help.name + ' ')) << help.name << ": " << example;
      for (const std::string& flag : flags_in(example)) {
        EXPECT_TRUE(std::ranges::find(names, flag) != names.end()) << example << ": " << flag;
      }
    }
  }
}

TEST(CommandLines, ExitCodeTwoIsBadInput) {
  for (const CommandHelp& help : all_help()) {
    EXPECT_TRUE(has(help.text, "Exit codes: 0 ")) << help.name;
    EXPECT_TRUE(has(help.text, "\\b2\\s+invalid\\s+(input|flags)")) << help.name;
  }
}

/// Characters of UTF-8.
std::size_t length_of(const std::string& line) {
  return static_cast<std::size_t>(std::ranges::count_if(
      line, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

TEST(CommandLines, HelpIsAsWideAsTheTerminal) {
  constexpr std::size_t kColumns = 50;
  for (const CommandHelp& help : all_help()) {
    if (!help.is_program) continue;
    std::istringstream lines(run_program(help.name + " --help", "COLUMNS=50 ").output);
    bool in_examples = false;
    for (std::string line; std::getline(lines, line);) {
      in_examples = (in_examples || line == "Examples:") && !line.starts_with("Exit codes");
      const bool is_one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      EXPECT_TRUE(in_examples || is_one_word || length_of(line) <= kColumns)
          << help.name << ": " << line;
    }
  }
}

struct Former {
  std::string command;
  std::string former;
  std::string now;
};

TEST(CommandLines, FormerNamesWorkWithAWarning) {
  for (const auto& [command, former, now] :
       {Former{"choose_trims x.csv", "--config", "--configuration"},
        Former{"automaton_request --dds_domain 0", "--vehicle", "--vehicle_ids"},
        Former{"high_level_controller --vehicle_ids 99 --transport loopback", "--dump-problems",
               "--dump_problems"},
        Former{"explain x", "--vehicle", "--vehicle_id"},
        Former{"compare_priorities circle", "--strategies", "--priorities"}}) {
    const std::string name = command.substr(0, command.find(' '));
    for (const std::string between : {" ", "="}) {
      const Outcome outcome = run_program(command + ' ' + former + between + "0x");
      EXPECT_EQ(outcome.exit_code, 2) << outcome.output;  // no former name is unknown
      EXPECT_TRUE(outcome.output.starts_with(name + ": " + former + " is now " + now + '\n'))
          << outcome.output;
      EXPECT_EQ(outcome.output.find("must be a flag"), std::string::npos) << outcome.output;
    }
  }
}

}  // namespace
}  // namespace hlc::test
