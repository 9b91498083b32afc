// Checks names, log lines and sentences for words that a reader from robotics or middleware would
// have to look up in this project: each has a standard term. Names of tests, which are statements,
// are exempt.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/folders.hpp"

namespace hlc {
namespace {

namespace fs = std::filesystem;

/// A word, or several, to avoid. `pattern` is a regular expression for whole words in lower case,
/// with a blank between the words of a name (`drive_out`, `driveOut`).
struct Word {
  std::string pattern;
  std::string better;
};
const std::vector<Word> kWords{
    {"twins?", "duplicate instance, counterpart"},
    {"say|says|said|saying", "publish, report, log, state"},
    {"tell|tells|told|telling", "announce, publish, log, report"},
    {"hear|hears|heard|hearing|deaf", "receive, matched, unmatched"},
    {"bury|buries|buried", "mark dead"},
    {"owe|owes|owed|owing", "pending"},
    {"carry|carries|carried|carrier|carriers|carry on|carries on", "forward, contain, continue"},
    {"who (lives|stands)|look at lanes|has rested|sets out", "update_..., is_departing"},
    {"misfits?|misplaced", "placement cost, off route"},
    {"gives? up|gave up|giving up|given up", "fall back, stop early"},
    {"wish|wishes|wished", "proposal, propose"},
    {"subgraph choice", "subgraph selector"},
    {"rehears(e|es|ed|al|als)", "look-ahead rollout"},
    {"plan watch", "deviation check"},
    {"(drive|drives|driving|driven|drove) out", "minimal-risk stop"},
    {"settle|settle rules?", "commit, commit rule"},
    {"own steps?", "self-loop"},
    {"above least", "reduced cost"},
    {"astray", "outside the announced area"},
    {"overlong", "exceeding the step"},
    {"allowed at most", "must be <="},
    {"any more", "no longer"},
    {"who is there", "live participants"},
    {"end it first", "stop it first"},
    {"whom", "name the process or the car"},
    {"thereby|in vain|for ever|anew|lest|hardly ever",
     "by this, without effect, forever, again, rarely"},
    {"to the last bit", "bitwise identical"},
    {"nobody solved|numbers arose|once more, alone|search may cost|nobody hears|judges here",
     "see CONTRIBUTING.md"},
};

/// Names that would be no error as words of a sentence; regular expressions.
const std::vector<Word> kNames{
    {R"(\b(fault_of|problem_with)\b)", "validate"},
    {R"(\bstarts\(\))", "start_trims()"},
    {R"(\bis_(on|off)\(\))", "is_enabled(), is_disabled()"},
    {R"(\bkLater\b)", "the name of the rule"},
};

/// Legitimate uses.
struct Exception {
  std::string file;  ///< from the root
  std::string text;  ///< of the line
  std::string why;
};
const std::vector<Exception> kExceptions{
    {"CHANGELOG.md", "it was `drive_out`", "names the renamed values"},
    {"CHANGELOG.md", "`overlong_", "names the renamed keys"},
    {"launch_scripts/scenarios/reconfiguration.yaml", "rehearsal",
     "records of runs hold the hashes of scenario files"},
    {"launch_scripts/scenarios/passenger_cars.yaml", "carry plans of 4 s",
     "records of runs hold the hashes of scenario files"},
    {"tests/integration/lab_network.cpp", "carrier", "of a network interface"},
};

bool is_searched(const std::string& file) {
  static const std::set<std::string> kExtensions{".cpp",  ".hpp", ".md",  ".sh",   ".py",
                                                 ".yaml", ".idl", ".txt", ".cmake"};
  if (file.starts_with("idl/lab/") || file == "tests/house/word_list_test.cpp") return false;
  return kExtensions.contains(fs::path(file).extension().string()) || file == ".ci/run";
}

/// All files of the project, from the root.
std::vector<std::string> searched_files() {
  const fs::path root = test::source_folder();
  std::vector<std::string> files;
  const auto add = [&](const fs::path& path) {
    const std::string file = path.lexically_relative(root).generic_string();
    if (fs::is_regular_file(path) && is_searched(file)) files.push_back(file);
  };
  for (const auto& entry : fs::directory_iterator(root)) add(entry.path());
  for (const char* top :
       {".ci", "hlc_bridge", "idl", "launch_scripts", "planner", "tests", "vehicle_sim"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) add(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Lower case, with the words of names separated by blanks.
std::string words_of(const std::string& line) {
  const auto is_lower = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  std::string words;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (i > 0 && is_upper(c) && is_lower(line[i - 1])) words += ' ';
    words += c == '_' ? ' ' : is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

/// The file's lines, without the names of tests.
std::vector<std::string> lines_of(const fs::path& path) {
  static const std::regex kTest(R"(\b(TEST(_F|_P)?\(\s*\w+,\s*)\w+)");
  std::ifstream stream(path);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (path.extension() == ".cpp") text = std::regex_replace(text, kTest, "$1");
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

/// What to use instead of a word in the line, for each that is found.
std::vector<std::string> findings(const std::string& line) {
  static const auto kPatterns = [] {
    std::vector<std::pair<std::regex, std::string>> patterns;
    for (const auto& [pattern, better] : kWords) {
      patterns.emplace_back(std::regex("\\b(" + pattern + ")\\b", std::regex::optimize), better);
    }
    return patterns;
  }();
  static const auto kNamePatterns = [] {
    std::vector<std::pair<std::regex, std::string>> patterns;
    for (const auto& [pattern, better] : kNames) patterns.emplace_back(pattern, better);
    return patterns;
  }();
  std::vector<std::string> found;
  std::smatch match;
  const auto search = [&](const std::string& text, const auto& patterns) {
    for (const auto& [pattern, better] : patterns) {
      if (std::regex_search(text, match, pattern)) {
        found.push_back("'" + match.str() + "', better: " + better);
      }
    }
  };
  search(words_of(line), kPatterns);
  search(line, kNamePatterns);
  return found;
}

bool is_exception(const std::string& file, const std::string& line) {
  return std::ranges::any_of(kExceptions, [&](const Exception& one) {
    return one.file == file && line.find(one.text) != std::string::npos;
  });
}

TEST(WordList, NoFileHasAWordWithABetterTerm) {
  const std::vector<std::string> files = searched_files();
  EXPECT_GT(files.size(), 500U);
  for (const std::string& file : files) {
    std::size_t number = 0;
    for (const std::string& line : lines_of(fs::path(test::source_folder()) / file)) {
      ++number;
      if (is_exception(file, line)) continue;
      for (const std::string& finding : findings(line)) {
        ADD_FAILURE() << file << ":" << number << ": " << finding;
      }
    }
  }
}

TEST(WordList, EveryExceptionIsNeeded) {
  for (const Exception& one : kExceptions) {
    EXPECT_TRUE(std::ranges::any_of(lines_of(fs::path(test::source_folder()) / one.file),
                                    [&](const std::string& line) {
                                      return line.find(one.text) != std::string::npos &&
                                             !findings(line).empty();
                                    }))
        << one.file << ": " << one.text;
  }
}

TEST(WordList, NamesAreReadByTheirWords) {
  EXPECT_FALSE(findings("void tell_others();").empty());
  EXPECT_FALSE(findings("class SubgraphChoice {").empty());
  EXPECT_FALSE(findings("// Waits for whom it needs.").empty());
  EXPECT_FALSE(findings("if (fault_of(plan).empty()) return;").empty());
  EXPECT_TRUE(findings("a fault of the run between two essays, on the shipped wall").empty());
}

}  // namespace
}  // namespace hlc
