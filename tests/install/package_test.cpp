// The Debian package: unpacked it drives, and it puts nothing where another package may.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/install/installed_tree.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test::package {
namespace {

namespace fs = std::filesystem;

class DebianPackage : public testing::Test {
 protected:
  void SetUp() override {
    if (run_command("command -v dpkg-deb dpkg-shlibdeps").exit_code != 0) {
      GTEST_SKIP() << "no dpkg-deb or dpkg-shlibdeps (package dpkg-dev)";
    }
    const Outcome outcome =
        run_command("cpack -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=none --config " +
                    build_folder() + "/CPackConfig.cmake -B " + folder_.path().string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      if (entry.path().extension() == ".deb") file_ = entry.path();
    }
    ASSERT_FALSE(file_.empty()) << outcome.output;
  }

  [[nodiscard]] std::string field(const std::string& name) const {
    return run_command("dpkg-deb -f " + file_.string() + " " + name).output;
  }

  /// Whether a path of the package is one that only hlc has, or a folder of every Debian.
  static bool is_our_own(const std::string& path) {
    static const std::vector<std::string> kFolders{
        "./",         "./usr/",           "./usr/bin/",   "./usr/include/",
        "./usr/lib/", "./usr/lib/cmake/", "./usr/share/", "./usr/share/doc/"};
    if (std::ranges::find(kFolders, path) != kFolders.end()) return true;
    return std::ranges::any_of(std::vector<std::string>{"./usr/bin/hlc-", "./usr/include/hlc/",
                                                        "./usr/lib/hlc/", "./usr/lib/cmake/hlc/",
                                                        "./usr/share/hlc/", "./usr/share/doc/hlc/"},
                               [&path](const std::string& own) { return path.starts_with(own); });
  }

  const TemporaryFolder folder_;
  fs::path file_;
};

TEST_F(DebianPackage, UnpackedDrivesTheFirstScenarioAndHasNothingOfOthers) {
  EXPECT_EQ(field("Package"), "hlc\n");
  EXPECT_THAT(field("Depends"), testing::HasSubstr("libfastrtps"));
  const fs::path root = folder_ / "root";
  ASSERT_EQ(run_command("dpkg-deb -x " + file_.string() + " " + root.string()).exit_code, 0);
  std::istringstream paths(
      run_command("dpkg-deb --fsys-tarfile " + file_.string() + " | tar -t").output);
  std::size_t num_paths = 0;
  for (std::string path; std::getline(paths, path); ++num_paths) {
    EXPECT_TRUE(is_our_own(path)) << path;
  }
  EXPECT_GT(num_paths, 100U);
  EXPECT_EQ(run_command("dpkg-deb --ctrl-tarfile " + file_.string() + " | tar -t | sort").output,
            "./control\n./md5sums\n")
      << "what a script makes, dpkg does not remove";
  expect_every_command(root / "usr");
  expect_it_drives(root / "usr");
}

}  // namespace
}  // namespace hlc::test::package
