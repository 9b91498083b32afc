// `evaluate`, interrupted by Ctrl-C, and called from any folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(EvaluateInterruption, NamesHowToGoOnAndTheSameCommandDoes) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";
  const std::vector<std::string> flags{
      "--scenario", "paper_red_alone", "--subgraphs", "B",     "--steps",
      "20",         "--jobs",          "1",           "--out", out.string()};
  std::vector<std::string> arguments{build_folder() + "/bin/evaluate", "--starts", "100000"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  ChildProcess evaluate(arguments, folder / "output");
  ASSERT_TRUE(eventually(60s, [&] { return read_text(out / "runs.jsonl").size() > 10'000; }));
  evaluate.send(SIGINT);
  EXPECT_EQ(evaluate.wait_for(60s), 130);
  EXPECT_THAT(read_text(folder / "output"),
              HasSubstr("evaluate: interrupted; finished runs are kept, and the same command goes "
                        "on with the others\n"));
  ChildProcess again(arguments, folder / "again");
  EXPECT_TRUE(eventually(60s, [&] {
    return read_text(folder / "again").find("of 100000 runs already driven") != std::string::npos;
  })) << read_text(folder / "again");
}

TEST(EvaluateInterruption, ShippedScenariosAreFoundFromAnyFolder) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      "evaluate --scenario paper_red_alone --steps 5 --out " + (folder / "out").string(),
      "cd / && ");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

}  // namespace
}  // namespace hlc::test
