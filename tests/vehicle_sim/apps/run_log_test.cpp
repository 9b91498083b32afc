#include "vehicle_sim/apps/run_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/child_process.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

using testing::HasSubstr;

constexpr char kHeading[] = R"({"seed":1,"files":["a"]})";

TEST(RunLog, OfAnAppendThatFailedNothingStays) {
  const test::TemporaryFolder folder;
  {
    RunLog log(folder / "out", kHeading);
    log.append(0, R"({"run":0})");
    const std::filesystem::path file = folder / "out" / "runs.jsonl";
    const std::string before = test::read_text(file);
    {
      const test::FullDisk disk(before.size() + 5);
      EXPECT_THROW(log.append(1, R"({"run":1})"), std::runtime_error);
    }
    EXPECT_EQ(test::read_text(file), before);
    EXPECT_FALSE(log.has(1));
    log.append(2, R"({"run":2})");
  }
  const RunLog again(folder / "out", kHeading);
  EXPECT_EQ(again.size(), 2U);
  EXPECT_TRUE(again.has(2));
}

TEST(RunLog, SaysInWhatAnotherCampaignDiffers) {
  const test::TemporaryFolder folder;
  { const RunLog log(folder / "out", kHeading); }
  try {
    const RunLog other(folder / "out", R"({"seed":1,"files":["b"],"steps":3})");
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("(there: files, steps)"));
  }
}

TEST(RunLog, ARowThatWasChangedIsRefused) {
  const test::TemporaryFolder folder;
  {
    RunLog log(folder / "out", kHeading);
    log.append(0, R"({"run":0,"start":4})");
    log.append(1, R"({"run":1,"start":5})");
  }
  const std::filesystem::path file = folder / "out" / "runs.jsonl";
  const std::string before = test::read_text(file);
  EXPECT_EQ(parse_run_rows(before).rows.at(1), R"({"run":1,"start":5})");
  for (std::size_t i = before.find('\n') + 1; i + 1 < before.size(); ++i) {
    std::string changed = before;
    changed[i] = changed[i] == '1' ? '2' : '1';
    EXPECT_THROW(static_cast<void>(parse_run_rows(changed)), std::invalid_argument) << i;
  }
}

TEST(RunLog, AFolderHasOneWriterAtATime) {
  const test::TemporaryFolder folder;
  {
    const RunLog log(folder / "out", kHeading);
    EXPECT_THROW(RunLog(folder / "out", kHeading), std::invalid_argument);
  }
  EXPECT_NO_THROW(RunLog(folder / "out", kHeading));
}

TEST(RunLog, RefusesWhatIsInTheWay) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "out" / "runs.jsonl");
  EXPECT_THROW(RunLog(folder / "out", kHeading), std::invalid_argument);
  const RunLog log(folder / "other", kHeading);
  EXPECT_NO_THROW(log.check_outputs({"table.md"}));
  std::filesystem::create_directories(folder / "other" / "table.md");
  EXPECT_THROW(log.check_outputs({"table.md"}), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::apps
