// The programs in the documents exist after `build.sh --programs`, those of a run after
// `build.sh --run_programs`, by which run_lab.sh builds.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Names after build/release/bin/ in the documents beside the sources; those of tests/ name
/// programs of tests.
std::set<std::string> documented_programs() {
  std::set<std::string> names;
  const std::regex program("build/release/bin/([a-z_]+)");
  const fs::path root = test::source_folder();
  for (const fs::path& room :
       {root / "planner", root / "hlc_bridge", root / "vehicle_sim", root / "launch_scripts"}) {
    for (const auto& entry : fs::recursive_directory_iterator(room)) {
      if (entry.path().extension() != ".md") continue;
      const std::string text = text_of(entry.path());
      for (std::sregex_iterator match(text.begin(), text.end(), program), end; match != end;
           ++match) {
        names.insert((*match)[1]);
      }
    }
  }
  return names;
}

TEST(Programs, EveryProgramOfADocumentIsBuiltByTheScript) {
  EXPECT_NE(
      text_of(test::source_folder() + "/launch_scripts/build.sh")
          .find("--programs | --run_programs | --unit_tests | --thread_tests) targets=(--target"),
      std::string::npos);
  const std::set<std::string> names = documented_programs();
  EXPECT_GE(names.size(), 5U);
  for (const std::string& name : names) {
    EXPECT_NE(std::string(HLC_PROGRAMS).find(" " + name + " "), std::string::npos) << name;
  }
}

/// Names after $bin/ in a script.
std::set<std::string> started_programs(const std::string& script) {
  const std::string text = text_of(test::source_folder() + "/launch_scripts/" + script);
  const std::regex program("\\$bin/([a-z_]+)");
  std::set<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), program), end; match != end; ++match) {
    names.insert((*match)[1]);
  }
  return names;
}

TEST(Programs, EveryProgramOfARunIsBuiltForIt) {
  std::set<std::string> names = started_programs("run_lab.sh");
  names.merge(started_programs("vehicle.sh"));
  EXPECT_GE(names.size(), 7U);
  // With --view, --commonroad, or a guest that is driven by hand, all are built.
  for (const std::string further : {"view", "import_commonroad", "drive_by_hand"})
    EXPECT_EQ(names.erase(further), 1U);
  for (const std::string& name : names) {
    EXPECT_NE(std::string(HLC_RUN_PROGRAMS).find(" " + name + " "), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hlc::test
