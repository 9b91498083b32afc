#include "planner/apps/output_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() {
    test::put(folder_ / "car.yaml", "");
    test::put(folder_ / "old.csv", "");
    fs::current_path(folder_.path());
  }
  ~OutputFiles() override { fs::current_path(before_); }

  /// The message, or "good".
  static std::string error_text(const std::vector<OutputFile>& outputs) {
    try {
      check_output_files(outputs, {"car.yaml"});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "good";
  }

  fs::path before_{fs::current_path()};
  test::TemporaryFolder folder_;
};

TEST_F(OutputFiles, NewAndRegularFilesAndNoneAreGood) {
  EXPECT_EQ(error_text({{"--out", "new.csv"}, {"--plot", folder_ / "old.csv"}, {"--table", {}}}),
            "good");
}

TEST_F(OutputFiles, WhatCannotBeAFileIsRefused) {
  fs::create_directory("folder");
  fs::create_symlink("old.csv", "link.csv");
  EXPECT_EQ(error_text({{"--out", ""}}), "--out = , must be the name of a file");
  EXPECT_EQ(error_text({{"--out", "no/new.csv"}}),
            "--out = no/new.csv, must be a file in an existing folder");
  EXPECT_EQ(error_text({{"--out", "old.csv/new.csv"}}),
            "--out = old.csv/new.csv, must be a file in an existing folder");
  for (const char* const other :
       {"folder", "folder/", ".", "link.csv", "/dev/stdout", "/dev/null"}) {
    EXPECT_EQ(error_text({{"--out", other}}),
              "--out = " + std::string(other) + ", must be a new or a regular file");
  }
}

TEST_F(OutputFiles, AFolderThatMayNotBeWrittenToIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::create_directory("folder");
  fs::permissions("folder", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(error_text({{"--out", "folder/new.csv"}}),
            "--out = folder/new.csv, must be a file in a writable folder");
}

TEST_F(OutputFiles, AnInputIsRefusedUnderAnyName) {
  fs::create_hard_link("car.yaml", "hard.yaml");
  for (const std::string& name : std::vector<std::string>{"car.yaml", "./car.yaml", "hard.yaml",
                                                          (folder_ / "car.yaml").string()}) {
    EXPECT_EQ(error_text({{"--out", "new.csv"}, {"--plot", name}}),
              "--plot = " + name + ", must be a file other than the input");
  }
}

TEST_F(OutputFiles, TwoOutputsInOneFileAreRefusedAlsoIfItIsNew) {
  for (const std::string& name :
       std::vector<std::string>{"new.csv", "./new.csv", (folder_ / "new.csv").string()}) {
    EXPECT_EQ(error_text({{"--out", "new.csv"}, {"--table", {}}, {"--plot", name}}),
              "--plot = " + name + ", must be a file other than that of --out");
  }
}

}  // namespace
}  // namespace hlc::apps
