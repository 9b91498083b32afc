// `evaluate --sweep`: files, resumption, invalid input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class EvaluateSweep : public testing::Test {
 protected:
  [[nodiscard]] Outcome sweep(const std::string& settings, const std::string& flags = "") const {
    put(folder_ / "sweep.yaml",
        "scenarios: [" + test::source_folder() +
            "/launch_scripts/scenarios/paper_red_alone.yaml]\nsubgraphs: [B, "
            "D]\nsteps: 20\nsettings: " +
            settings + "\n");
    return run_program("evaluate --sweep " + (folder_ / "sweep.yaml").string() + " --out " +
                       out_.string() + " " + flags);
  }

  TemporaryFolder folder_;
  std::filesystem::path out_{folder_ / "out"};
};

TEST_F(EvaluateSweep, GoesOnWhereItWasInterrupted) {
  const std::string settings = "{drivable: [lanes, everywhere]}";
  const Outcome whole = sweep(settings, "--jobs 2");
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
  EXPECT_THAT(whole.output, HasSubstr("4 runs, 0 do not count"));
  const std::string csv = read_text(out_ / "runs.csv");
  const std::string lines = read_text(out_ / "runs.jsonl");
  // Killed while it wrote the third run.
  std::size_t cut = 0;
  for (int line = 0; line < 3; ++line) cut = lines.find('\n', cut) + 1;
  put(out_ / "runs.jsonl", lines.substr(0, cut + 20));
  std::filesystem::remove(out_ / "runs.csv");
  const Outcome again = sweep(settings);
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("2 of 4 runs already driven"));
  EXPECT_EQ(read_text(out_ / "runs.csv"), csv);
  EXPECT_THAT(csv, HasSubstr("run,combination,set.drivable,scenario,"));
  EXPECT_THAT(csv, HasSubstr("\n1,0,lanes,paper_red_alone,default,D,none,0,,"));
  EXPECT_THAT(csv, Not(HasSubstr("planning_mean_ms"))) << "a sweep does not measure times";
  const auto campaign = nlohmann::json::parse(read_text(out_ / "campaign.json"));
  EXPECT_EQ(campaign["kind"], "sweep");
  EXPECT_EQ(campaign["sweep"]["settings"][0]["values"], (nlohmann::json{"lanes", "everywhere"}));
  EXPECT_EQ(campaign["sweep"]["trims"]["offered"]["D"], (nlohmann::json{1, 2, 4, 6, 7, 8, 10, 12}));
  EXPECT_EQ(campaign["sweep"]["trims"]["moving"].front(), 2);
}

TEST_F(EvaluateSweep, ExitCodeTellsThatACombinationCouldNotBeDriven) {
  const Outcome outcome = sweep("{steering_rate_radps: [2, 6.2]}");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("4 runs, 2 do not count"));
  // What was not driven has no figures.
  EXPECT_THAT(read_text(out_ / "runs.csv"),
              testing::MatchesRegex("(.*\n)*0,0,2,paper_red_alone,default,B,none,0,[^\n]*maneuver"
                                    "[^\n]*,,,,,,,,,,,,,,,,,,,,,,\n(.*\n)*"));
}

TEST_F(EvaluateSweep, BadInputIsOneLineExitCode2AndNothingWritten) {
  const Outcome setting = sweep("{colour: [red]}");
  EXPECT_EQ(setting.exit_code, 2);
  EXPECT_THAT(setting.output, HasSubstr("sweep.yaml:4: settings.colour"));
  EXPECT_EQ(setting.output.find('\n'), setting.output.size() - 1) << setting.output;
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(sweep("{lap: [flying]}", "--starts 2").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(EvaluateSweep, RefusesTheFolderOfAnotherSweep) {
  ASSERT_EQ(sweep("{lap: [flying]}").exit_code, 0);
  const std::string before = read_text(out_ / "runs.jsonl");
  const Outcome outcome = sweep("{lap: [standing]}");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(read_text(out_ / "runs.jsonl"), before);
}

}  // namespace
}  // namespace hlc::test
