#include "hlc_bridge/record/log_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using test::put;

TEST(LogFiles, LinesAreInTheOrderOfTheirStamps) {
  const test::TemporaryFolder folder;
  put(folder / "b_1.log",
      "[2026-01-31 10:00:00.500] [info] b_1: starts\n\n[2026-01-31 10:00:02.000] [warning] late\n");
  put(folder / "a.log", "[2026-01-31 10:00:01.000] [error] a: fails: [x] [y] z\n  details\n");
  put(folder / "a.pids", "1 2 3\n");
  std::filesystem::create_directory(folder / "folder.log");
  const std::vector<result::LoggedLine> lines = read_logs(folder.path(), {});
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].process, "b_1");
  EXPECT_EQ(lines[0].text, "starts");
  EXPECT_EQ(lines[1].level, "error");
  EXPECT_EQ(lines[1].text, "fails: [x] [y] z");
  EXPECT_EQ(lines[2].text, "  details");
  EXPECT_EQ(lines[2].stamp, "");
  EXPECT_EQ(lines[3].stamp, "2026-01-31 10:00:02.000");
  EXPECT_EQ(lines[3].text, "late");
}

TEST(LogFiles, OnlyInRealTimeALineHasATimeOfTheRun) {
  const test::TemporaryFolder folder;
  put(folder / "a.log", "[2026-01-31 10:00:01.250] [info] x\n[not a time] [info] y\n");
  std::tm noon{.tm_sec = 0, .tm_min = 0, .tm_hour = 10, .tm_mday = 31, .tm_mon = 0, .tm_year = 126};
  noon.tm_isdst = -1;
  result::RunFacts facts;
  facts.period = 200'000'000;
  facts.first_step = 5 * static_cast<std::uint64_t>(std::mktime(&noon));
  for (const result::LoggedLine& line : read_logs(folder.path(), facts)) {
    EXPECT_EQ(line.run_s.has_value(), line.text == "x");
    EXPECT_NEAR(line.run_s.value_or(1.25), 1.25, 1e-6);
  }
  facts.simulated_time = true;
  for (const result::LoggedLine& line : read_logs(folder.path(), facts)) {
    EXPECT_FALSE(line.run_s);
  }
}

TEST(LogFiles, AreBoundedAndMayBeMissing) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(read_logs(folder / "logs", {}).empty());
  std::string text;
  for (std::size_t i = 0; i < kMostLoggedLines + 7; ++i) text += "line\n";
  put(folder / "a.log", text);
  const std::vector<result::LoggedLine> lines = read_logs(folder.path(), {});
  ASSERT_EQ(lines.size(), kMostLoggedLines + 1);
  EXPECT_THAT(lines.back().text, testing::StartsWith("7 further lines"));
}

TEST(GrowingLogs, HaveEveryLineOnceAsSoonAsItIsWhole) {
  const test::TemporaryFolder folder;
  GrowingLogs logs(folder / "logs");
  EXPECT_TRUE(logs.new_lines({}).empty());
  std::filesystem::create_directory(folder / "logs");
  const auto append = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / "logs" / name, std::ios::app) << text;
  };
  const auto texts = [&] {
    std::vector<std::string> texts;
    for (const result::LoggedLine& line : logs.new_lines({})) texts.push_back(line.text);
    return texts;
  };
  append("b.log", "[2026-01-31 10:00:00.500] [info] b: starts\n[2026-01-31 10");
  EXPECT_THAT(texts(), testing::ElementsAre("starts"));
  EXPECT_THAT(texts(), testing::IsEmpty());
  append("b.log", ":00:01.000] [warning] b: late\n");
  append("a.log", "x\ny\n");
  EXPECT_THAT(texts(), testing::UnorderedElementsAre("late", "x", "y"));
}

TEST(GrowingLogs, AreBounded) {
  const test::TemporaryFolder folder;
  GrowingLogs logs(folder.path());
  std::string text;
  for (std::size_t i = 0; i < kMostLoggedLines - 1; ++i) text += "line\n";
  put(folder / "a.log", text);
  EXPECT_EQ(logs.new_lines({}).size(), kMostLoggedLines - 1);
  put(folder / "b.log", "one\ntwo\nthree\n");
  const std::vector<result::LoggedLine> lines = logs.new_lines({});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text, "one");
  EXPECT_THAT(lines[1].text, testing::StartsWith("further lines, see the files in"));
  put(folder / "c.log", "more\n");
  EXPECT_TRUE(logs.new_lines({}).empty());
}

}  // namespace
}  // namespace hlc::record
