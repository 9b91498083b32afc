#include "hlc_bridge/process/progress_line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace hlc::process {
namespace {

class ProgressLineTest : public testing::Test {
 protected:
  std::string written() {
    std::rewind(file_.get());
    std::array<char, 4096> text{};
    const std::size_t size = std::fread(text.data(), 1, text.size(), file_.get());
    return {text.data(), size};
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{std::tmpfile(), &std::fclose};
};

TEST_F(ProgressLineTest, LogFileGetsALineEachTime) {
  ProgressLine line{file_.get(), false};
  line.show("101");
  line.show("106");
  line.end_line();
  EXPECT_EQ(written(), "101\n106\n");
  EXPECT_EQ(ProgressLine::interval(false), Nanoseconds{5'000'000'000});
}

TEST_F(ProgressLineTest, TerminalHasOneLineThatIsRewritten) {
  ProgressLine line{file_.get(), true};
  line.show("step 1");
  line.show("step 2");
  line.end_line();
  line.end_line();
  EXPECT_EQ(written(), "\r\x1b[Kstep 1\r\x1b[Kstep 2\n");
}

TEST_F(ProgressLineTest, TerminalLineIsCutToItsWidth) {
  ProgressLine line{file_.get(), true};
  line.show(std::string(500, 'x'));
  EXPECT_LE(written().size(), ProgressLine::kTerminalColumns + std::string("\r\x1b[K").size());
}

TEST_F(ProgressLineTest, NothingShownNeedsNoEnd) {
  ProgressLine line{file_.get(), true};
  line.end_line();
  EXPECT_EQ(written(), "");
}

}  // namespace
}  // namespace hlc::process
