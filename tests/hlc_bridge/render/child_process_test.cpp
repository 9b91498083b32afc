#include "hlc_bridge/render/child_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <optional>

#include "planner/common/temporary_folder.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::render {
namespace {

std::string everything_from(const Descriptor& file) {
  std::string text;
  std::array<char, 256> buffer{};
  for (ssize_t count = 1; count > 0; text.append(buffer.data(), static_cast<std::size_t>(count))) {
    count = ::read(file.number(), buffer.data(), buffer.size());
    if (count < 0) count = 0;
  }
  return text;
}

TEST(ChildProcess, HasTheFilesThatItIsGivenAsItsFirstOnes) {
  Pipe to = make_pipe();
  Pipe from = make_pipe();
  const Descriptor nothing = open_file("/dev/null", O_RDWR);
  ChildProcess child(
      {"/bin/sh", "-c", "cat <&4 >&3"},
      {nothing.number(), nothing.number(), nothing.number(), from.in.number(), to.out.number()});
  from.in.close();
  to.out.close();
  write_all(to.in, "frames");
  to.in.close();
  EXPECT_EQ(everything_from(from.out), "frames");
  EXPECT_TRUE(child.is_good_at_end());
}

TEST(ChildProcess, EndsWithTheObjectAndItsOwnChildrenToo) {
  Pipe pipe = make_pipe();
  const Descriptor nothing = open_file("/dev/null", O_RDWR);
  std::optional<ChildProcess> child;
  child.emplace(std::vector<std::string>{"/bin/sh", "-c", "sleep 1000 & echo $!; wait"},
                std::vector<int>{nothing.number(), pipe.in.number()});
  pipe.in.close();
  std::array<char, 16> id{};
  ASSERT_GT(::read(pipe.out.number(), id.data(), id.size()), 0);
  child.reset();
  EXPECT_EQ(everything_from(pipe.out), "") << "the pipe ends with the last process that has it";
}

TEST(ChildProcess, AFailedProgramIsNotGoodAtItsEnd) {
  ChildProcess child({"/bin/false"}, {});
  EXPECT_FALSE(child.is_good_at_end());
}

TEST(ChildProcess, AProgramThatIsNotInstalledIsNamedWithItsPackage) {
  EXPECT_EQ(path_of("sh").substr(path_of("sh").rfind('/')), "/sh");
  EXPECT_EQ(path_of("no_such_program"), "");
  EXPECT_THAT([] { return needed_path_of("no_such_program", "some-package"); },
              testing::ThrowsMessage<Fault>(
                  "no_such_program is not installed: apt-get install some-package (Debian)"));
}

TEST(ChildProcess, TheLastLineOfItsLogIsTheLastThatIsNotEmpty) {
  const TemporaryFolder folder;
  write_file(folder / "log", "first\nlast\n\n");
  EXPECT_EQ(last_line_of(folder / "log"), "last");
}

}  // namespace
}  // namespace hlc::render
