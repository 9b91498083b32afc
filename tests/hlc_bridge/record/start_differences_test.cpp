#include "hlc_bridge/record/start_differences.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kFlags[] = "scenario: /here/s.yaml\nsteps: 20\nseed: null\ndds_domain: 3\n";

/// Two runs that were started alike, from files in their own folders.
class StartDifferences : public testing::Test {
 protected:
  StartDifferences() : a_{run("a")}, b_{run("b")} {}

  [[nodiscard]] RunFolder run(const std::string& name) const {
    RunFolder run{.folder = folder_ / name};
    std::filesystem::create_directories(run.folder / "configuration");
    test::put(run.folder / "configuration" / "flags.yaml", kFlags);
    run.scenario.file = file(name + "/s.yaml", "line 1\nline 2\n");
    run.scenario.automaton_file = file(name + "/trims.yaml", "trims");
    return run;
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& text) const {
    test::put(folder_ / name, text);
    return folder_ / name;
  }
  [[nodiscard]] std::vector<std::string> lines() const { return start_differences(a_, b_); }

  test::TemporaryFolder folder_;
  RunFolder a_;
  RunFolder b_;
};

TEST_F(StartDifferences, AreNoneForEqualFilesInDifferentFolders) {
  EXPECT_THAT(lines(), IsEmpty());
}

TEST_F(StartDifferences, NameTheFirstLineThatDiffers) {
  b_.scenario.file = file("b/s.yaml", "line 1\nline two\n");
  EXPECT_THAT(lines(), ElementsAre("scenario s.yaml: other text from line 2 on"));
  b_.scenario.file = file("b/s.yaml", "line 1\nline 2\nline 3\n");
  EXPECT_THAT(lines(), ElementsAre("scenario s.yaml: other text from line 3 on"));
}

TEST_F(StartDifferences, NameFilesOfOtherNamesAndThoseOfOneRunOnly) {
  b_.scenario.automaton_file = file("b/other.yaml", "other trims");
  a_.scenario.map_file = file("a/map.xml", "<map/>");
  b_.scenario.lab_file = file("b/lab.yaml", "lab");
  EXPECT_THAT(lines(), ElementsAre("automaton: trims.yaml and other.yaml", "map: map.xml and null",
                                   "lab: null and lab.yaml"));
  b_.scenario.automaton_file = file("b/other.yaml", "trims");
  EXPECT_THAT(lines().front(), "automaton: trims.yaml and other.yaml, with the same text");
}

TEST_F(StartDifferences, NameFlagsByTheirValues) {
  test::put(b_.folder / "configuration" / "flags.yaml",
            "scenario: /there/s.yaml\nsteps: 30\nseed: 4\ndds_domain: 9\nstamps: lab\n");
  EXPECT_THAT(lines(), ElementsAre("seed: null and 4", "stamps: null and lab", "steps: 20 and 30"));
}

TEST(RunFolder, WithoutItsRecordsIsNone) {
  const test::TemporaryFolder folder;
  const auto error = [&] {
    try {
      std::ignore = read_run_folder(folder.path());
    } catch (const std::invalid_argument& what) {
      return std::string(what.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(error(), folder.path().string() + ": no run folder, run.json is missing");
  test::put(folder / "run.json", "{}");
  EXPECT_THAT(error(), HasSubstr("configuration/flags.yaml is missing"));
  std::filesystem::create_directory(folder / "configuration");
  test::put(folder / "configuration" / "flags.yaml", kFlags);
  EXPECT_THAT(error(), HasSubstr("reports.csv is missing"));
}

}  // namespace
}  // namespace hlc::record
