#include "hlc_bridge/render/child_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
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

/// Whether the last process that has the pipe's other end open has ended, after a minute at most.
bool is_closed(const Pipe& pipe) {
  pollfd end{.fd = pipe.out.number(), .events = 0, .revents = 0};
  return ::poll(&end, 1, 60'000) == 1 && (end.revents & POLLHUP) != 0;
}

TEST(ChildProcess, EndsWithTheObjectAndItsOwnChildrenToo) {
  Pipe pipe = make_pipe();
  const Descriptor nothing = open_file("/dev/null", O_RDWR);
  std::optional<ChildProcess> child;
  child.emplace(std::vector<std::string>{"/bin/sh", "-c", "sleep 1000 & echo; wait"},
                std::vector<int>{nothing.number(), pipe.in.number()});
  pipe.in.close();
  char started{};
  ASSERT_EQ(::read(pipe.out.number(), &started, 1), 1);
  child.reset();
  EXPECT_TRUE(is_closed(pipe));
}

TEST(ChildProcess, EndsWithTheProgramThatStartedItEvenIfThatIsKilled) {
  Pipe pipe = make_pipe();
  const pid_t starter = ::fork();
  if (starter == 0) {
    const Descriptor nothing = open_file("/dev/null", O_RDWR);
    const ChildProcess child({"/bin/sh", "-c", "echo; exec sleep 1000"},
                             {nothing.number(), pipe.in.number()});
    ::pause();
    ::_exit(1);
  }
  pipe.in.close();
  char started{};
  ASSERT_EQ(::read(pipe.out.number(), &started, 1), 1);
  ::kill(starter, SIGKILL);
  ::waitpid(starter, nullptr, 0);
  EXPECT_TRUE(is_closed(pipe));
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
  write_file(folder / "log", "");
  EXPECT_EQ(last_line_of(folder / "log"), "no message");
}

}  // namespace
}  // namespace hlc::render
