// Checks names, log lines and sentences for words that a reader from robotics or middleware would
// have to look up in this project: each has a standard term. Names of tests, which are statements,
// are exempt.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

/// Words to avoid, separated by commas, and the terms to use. In lower case; several words, or the
/// words of a name (`drive_out`, `driveOut`), are separated by blanks.
struct Words {
  std::string avoid;
  std::string better;
};
const std::vector<Words> kWords{
    {"twin, twins", "duplicate instance, counterpart"},
    {"say, says, said, saying", "publish, report, log, state"},
    {"tell, tells, told, telling", "announce, publish, log, report"},
    {"hear, hears, heard, hearing", "receive, be matched with"},
    {"deaf", "unmatched"},
    {"bury, buries, buried", "mark dead"},
    {"owe, owes, owed, owing", "pending replies"},
    {"carry, carries, carried, carrier, carry on", "forward, contain, continue"},
    {"note who, look at lanes, has rested, sets out", "update, standstill timeout, is departing"},
    {"misfit, misplaced", "placement cost, off route"},
    {"give up, gives up, gave up, giving up, given up", "fall back, stop early, time out"},
    {"wish, wishes, wished", "proposal, propose"},
    {"subgraph choice", "subgraph selector"},
    {"rehearse, rehearses, rehearsed, rehearsal, rehearsals", "look-ahead rollout"},
    {"plan watch", "deviation check"},
    {"drive out, drives out, drove out, driving out", "minimal-risk stop"},
    {"settle, settle rule, settle rules", "commit, commit rule"},
    {"own step, own steps", "self-loop"},
    {"above least", "reduced cost"},
    {"astray", "outside the announced area"},
    {"overlong", "exceeding the step"},
    {"allowed at most", "must be <="},
    {"any more, is there no more", "no longer"},
    {"who is there, who was there", "live and lost participants"},
    {"end it first", "stop it first"},
    {"whom", "the noun: which process, which vehicle"},
    {"thereby, in vain, for ever, anew, hardly ever", "by this, without effect, forever, again"},
    {"to the last bit", "bitwise identical"},
    {"trim that is on, trim that is off, trim is on, trim is off", "enabled, disabled"},
    {"nobody solved", "new weights, computed on request"},
    {"numbers arose", "the rules that produced the numbers"},
    {"search may cost", "limits the search effort"},
    {"judges here", "all checks use external packages"},
};

/// Names that would be no error as words of a sentence.
const std::vector<Words> kNames{
    {"fault_of", "validate"},    {"problem_with", "validate"},       {"starts()", "start_trims()"},
    {"is_on()", "is_enabled()"}, {"kLater", "the name of the rule"},
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

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

/// The line's words in lower case, each between blanks, names split into theirs; a dot for anything
/// else.
std::string words_of(const std::string& line) {
  std::string words(1, ' ');
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool begins = i > 0 && is_upper(c) && is_letter(line[i - 1]) && !is_upper(line[i - 1]);
    if ((begins || !is_letter(c)) && words.back() != ' ') words += ' ';
    if (is_letter(c)) {
      words += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (c != '_' && c != ' ') {
      words += ". ";
    }
  }
  return words + ' ';
}

/// The file's lines, without the names of tests.
std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream stream(path);
  std::vector<std::string> lines;
  bool is_test = false;  // the name is on this line, or on the next
  for (std::string line; std::getline(stream, line);) {
    is_test = is_test || line.starts_with("TEST");
    if (is_test) {
      is_test = line.find(')') == std::string::npos;
      line.clear();
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The words to avoid, one by one.
std::vector<Words> phrases() {
  std::vector<Words> phrases;
  for (const auto& [avoid, better] : kWords) {
    std::istringstream list(avoid);
    for (std::string phrase; std::getline(list >> std::ws, phrase, ',');) {
      phrases.push_back({.avoid = " " + phrase + " ", .better = better});
    }
  }
  return phrases;
}

bool has_name(const std::string& line, const std::string& name) {
  const auto is_part = [&](std::size_t i) {
    return i < line.size() && (is_letter(line[i]) || line[i] == '_');
  };
  for (std::size_t at = 0; (at = line.find(name, at)) != std::string::npos; ++at) {
    const bool ends = name.back() == ')' || !is_part(at + name.size());
    if (ends && (at == 0 || !is_part(at - 1))) return true;
  }
  return false;
}

/// Keys of input files that users have been given by these names.
constexpr const char* kKeys[] = {"own_steps"};

std::string without_keys(std::string line) {
  for (const std::string key : kKeys) {
    for (std::size_t at = 0; (at = line.find(key, at)) != std::string::npos;) {
      line.erase(at, key.size());
    }
  }
  return line;
}

/// What to use instead, for each word or name of the line that is to be avoided.
std::vector<std::string> findings(const std::string& line) {
  static const std::vector<Words> kPhrases = phrases();
  std::vector<std::string> found;
  const auto add = [&](const Words& one) {
    found.push_back("'" + one.avoid + "', better: " + one.better);
  };
  const std::string words = words_of(without_keys(line));
  for (const Words& one : kPhrases) {
    if (words.find(one.avoid) != std::string::npos) add(one);
  }
  for (const Words& one : kNames) {
    if (has_name(line, one.avoid)) add(one);
  }
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
  EXPECT_TRUE(findings("no fault of the run between two essays, on the shipped wall").empty());
  EXPECT_TRUE(findings("restarts(); is_only(); default_of(plan)").empty());
}

}  // namespace
}  // namespace hlc::test
