// The programs in the documents exist after the first run of run_lab.sh, which builds by
// `build.sh --programs`.
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
  EXPECT_NE(text_of(test::source_folder() + "/launch_scripts/build.sh")
                .find("--programs | --unit_tests | --thread_tests) targets=(--target"),
            std::string::npos);
  const std::set<std::string> names = documented_programs();
  EXPECT_GE(names.size(), 5U);
  for (const std::string& name : names) {
    EXPECT_NE(std::string(HLC_PROGRAMS).find(" " + name + " "), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace hlc::test
