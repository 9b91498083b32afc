#include "planner/common/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace hlc {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::ptrdiff_t num_files(const test::TemporaryFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), {});
}

TEST(WriteAtomically, TouchesNoOtherFile) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "c.yaml";
  test::put(file, "old");
  const std::string own = file.string() + "." + std::to_string(getpid()) + "_0.part";
  for (const std::string& other : {file.string() + ".part", own}) test::put(other, "of the user");
  write_file(file, "new");
  EXPECT_EQ(text_of(file), "new");
  EXPECT_EQ(text_of(file.string() + ".part"), "of the user");
  EXPECT_EQ(text_of(own), "of the user");
  EXPECT_EQ(num_files(folder), 3);
}

TEST(WriteAtomically, OfProcessesThatWriteTheSameFileOneLeavesItsWholeText) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "c.yaml";
  constexpr int kProcesses = 4;
  constexpr std::size_t kSize = 300'000;
  for (int i = 0; i < kProcesses; ++i) {
    if (fork() != 0) continue;
    int code = 0;
    try {
      for (int round = 0; round < 50; ++round) {
        write_file(file, std::string(kSize, static_cast<char>('a' + i)));
      }
    } catch (const std::exception&) {
      code = 1;
    }
    _exit(code);
  }
  for (int i = 0; i < kProcesses; ++i) {
    int status = 0;
    ASSERT_GT(wait(&status), 0);
    EXPECT_EQ(status, 0) << "a process could not write";
  }
  const std::string text = text_of(file);
  EXPECT_EQ(text, std::string(kSize, text.empty() ? '-' : text.front()));
  EXPECT_EQ(num_files(folder), 1);
}

TEST(WriteAtomically, RefusesWhatIsThereAndNoRegularFile) {
  const test::TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_directory(folder / "folder");
  test::put(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  for (const fs::path& path :
       {pipe, folder / "folder", folder / "link", folder / "no" / "c.yaml"}) {
    EXPECT_THROW(write_file(path, "new"), std::runtime_error) << path;
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(num_files(folder), 4);
}

TEST(TextFile, ReadsBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const std::string& content :
       {std::string{}, std::string{"a\nb"}, std::string(100'000, 'x')}) {
    write_file(folder / "file", content);
    EXPECT_EQ(read_file(folder / "file"), content);
  }
}

TEST(TextFile, WritingLeavesNothingElseBehind) {
  const test::TemporaryFolder folder;
  write_file(folder / "file", "old");
  write_file(folder / "file", "new");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator{folder.path()}) {
    EXPECT_EQ(entry.path().filename(), "file");
    ++files;
  }
  EXPECT_EQ(files, 1U);
}

TEST(TextFile, FailureNamesTheFile) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { write_file(folder / "no" / "file", "x"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no/file: cannot be written")));
  EXPECT_THAT([&] { (void)read_file(folder / "nothing"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("nothing: cannot be read")));
}

TEST(Split, KeepsEmptyPieces) {
  EXPECT_THAT(split("a,,b,", ','), ElementsAre("a", "", "b", ""));
  EXPECT_THAT(split("", ','), ElementsAre(""));
}

struct Unreadable {
  std::string name;
  std::function<void(const fs::path&)> make;
  std::string reason;
};
void PrintTo(const Unreadable& one, std::ostream* out) { *out << one.name; }

class UnreadableFiles : public testing::TestWithParam<Unreadable> {};

// A pipe without a writer was waited for, and a device read until the memory was full.
TEST_P(UnreadableFiles, EndInOneLine) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "input";
  GetParam().make(file);
  EXPECT_THAT([&] { static_cast<void>(read_regular_file(file, "a YAML file")); },
              ThrowsMessage<std::invalid_argument>(file.string() + GetParam().reason));
  EXPECT_THROW(static_cast<void>(read_file(file, kMostInputBytes)), std::runtime_error);
}

constexpr const char* kNotRegular = ": cannot be read, must be a YAML file";

INSTANTIATE_TEST_SUITE_P(
    ReadFile, UnreadableFiles,
    testing::Values(
        Unreadable{"Absent", [](const fs::path&) {}, kNotRegular},
        Unreadable{"Folder", [](const fs::path& file) { fs::create_directory(file); }, kNotRegular},
        Unreadable{"Pipe", [](const fs::path& file) { EXPECT_EQ(mkfifo(file.c_str(), 0600), 0); },
                   kNotRegular},
        Unreadable{"Device", [](const fs::path& file) { fs::create_symlink("/dev/zero", file); },
                   kNotRegular},
        Unreadable{"TooLong",
                   [](const fs::path& file) {
                     test::put(file, "");
                     fs::resize_file(file, 100'000'000);
                   },
                   ": 100000000 bytes, must be <= 67108864"}),
    [](const auto& one) { return one.param.name; });

TEST(ReadFile, ReadsWhatHasNoSize) {
  EXPECT_THAT(read_file("/proc/self/status"), HasSubstr("Pid:"));
}

TEST(ReadFile, ReadsUpToTheLimit) {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "input";
  test::put(file, "1234");
  EXPECT_EQ(read_file(file, 4), "1234");
  EXPECT_THROW(static_cast<void>(read_file(file, 3)), std::runtime_error);
}

}  // namespace
}  // namespace hlc
