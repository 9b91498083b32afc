// The program with steps of a run, and with what it must refuse.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "hlc_bridge/record/explanation_file.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Ten cars on the lab's network, 12 steps.
class Explain : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const scenario::Scenario scenario = scenario::read_scenario(
        {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml",
         .cars = 10,
         .seed = 3});
    experiment() = closed_loop::drive_experiment(scenario, {.steps = 12});
    run_folder::write_run_folder(run(), scenario, std::nullopt, experiment());
  }
  static void TearDownTestSuite() { fs::remove_all(run()); }

  [[nodiscard]] static closed_loop::Experiment& experiment() {
    static closed_loop::Experiment experiment;
    return experiment;
  }
  [[nodiscard]] static const test::TemporaryFolder& folder() {
    static const test::TemporaryFolder kFolder;
    return kFolder;
  }
  [[nodiscard]] static fs::path run() { return folder().path() / "run"; }
  [[nodiscard]] static test::Outcome explain(const std::string& flags) {
    return test::run_program("explain --run " + run().string() + " " + flags);
  }
};

TEST_F(Explain, EveryStepInWhichAVehicleWaitsNamesForWhichAndWhatItWouldDoWithoutAllOthers) {
  std::size_t num_waiting = 0;
  for (const ReportRecord& record : experiment().reports) {
    const coordination::Report& report = record.report;
    if (report.waiting.vehicles.empty() || num_waiting == 1) continue;
    const std::uint64_t step = report.step.value - *experiment().facts.first_step;
    if (step == 0) continue;
    ++num_waiting;
    const auto [exit_code, output] = explain(
        "--vehicle_id " + std::to_string(report.vehicle.value) + " --step " + std::to_string(step));
    EXPECT_EQ(exit_code, 0) << output;
    EXPECT_THAT(output,
                HasSubstr("waiting for " + std::to_string(report.waiting.vehicles[0].value)));
    EXPECT_THAT(output, HasSubstr("\nalone           a new plan "));
  }
  EXPECT_GT(num_waiting, 0U);
}

TEST_F(Explain, NoLineIsWiderThanANarrowTerminal) {
  const std::string command = "explain --run " + run().string() + " --vehicle_id 1 --step 10";
  EXPECT_NE(test::lines_beyond(60, test::run_program(command).output), "");
  const test::Outcome narrow = test::run_program(command, "COLUMNS=60 ");
  EXPECT_EQ(narrow.exit_code, 0) << narrow.output;
  EXPECT_EQ(test::lines_beyond(60, narrow.output), "");
}

TEST_F(Explain, TheProblemsOfTheStepCanBeSolvedAgainAndHaveTheSameRunnerUp) {
  const fs::path problems = folder().path() / "problems";
  const test::Outcome outcome =
      explain("--vehicle_id 1 --step 10 --dump_problems " + problems.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  ASSERT_FALSE(fs::is_empty(problems));
  fs::path last;
  for (const fs::directory_entry& entry : fs::directory_iterator(problems)) {
    const std::string name = entry.path().filename().string();
    if (name.find("_search_") != std::string::npos) last = std::max(last, entry.path());
  }
  const fs::path tree = folder().path() / "tree.json";
  const test::Outcome planned =
      test::run_program("plan_problem " + last.string() + " --tree " + tree.string());
  ASSERT_EQ(planned.exit_code, 0) << planned.output;
  const auto json = nlohmann::json::parse(std::ifstream(tree), nullptr, false);
  const auto& second = json["alternatives"][json["runner_up"].get<std::size_t>()];
  EXPECT_THAT(outcome.output, HasSubstr("it begins with "));
  EXPECT_THAT(outcome.output,
              HasSubstr(fmt::format(", {:+.3g} m^2\n", second["extra"].get<double>())));
}

TEST_F(Explain, TreeKeepsWhatWasSearchedInTheFolderAndInThePage) {
  const test::Outcome outcome = explain("--vehicle_id 1 --step 10 --tree");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const fs::path page = run() / "searches" / "vehicle_1_step_10.html";
  EXPECT_THAT(outcome.output, HasSubstr("what was searched: " + page.string()));
  EXPECT_THAT(read_file(page), HasSubstr("<h1>What was searched for one plan</h1>"));
  EXPECT_THAT(read_file(run() / "run.html"), HasSubstr(R"("kind":"search")"));
  fs::remove_all(page.parent_path());
  const test::Outcome summarized = test::run_program("summarize --run " + run().string());
  EXPECT_EQ(summarized.exit_code, 0) << summarized.output;
  EXPECT_EQ(read_file(run() / "run.html").find(R"("kind":"search")"), std::string::npos);
}

TEST(ExplainTree, OfACostToGoThatIsNoBoundIsRefusedBeforeAnythingIsWritten) {
  const test::TemporaryFolder folder;
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml",
       .profile = "2022"});
  run_folder::write_run_folder(folder / "run", scenario, std::nullopt,
                               closed_loop::drive_experiment(scenario, {.steps = 3}));
  const std::string run = (folder / "run").string();
  const std::string problems = (folder / "problems").string();
  const std::string command =
      "explain " + run + " --vehicle_id 1 --step 2 --dump_problems " + problems;
  const test::Outcome refused = test::run_program(command + " --tree");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.output, "explain: " + run +
                                ": cost_to_go = 2022, must be reachable or straight_line for a "
                                "search tree\n");
  EXPECT_FALSE(fs::exists(problems));
  EXPECT_EQ(test::run_program(command).exit_code, 0);
}

TEST_F(Explain, AllWritesTheFirstStepOfEveryHindranceAndThePageWithThem) {
  const test::Outcome outcome = explain("--all");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const record::RunFolder read = record::read_run_folder(run());
  const std::vector<result::Explanation> written = record::read_explanations(run(), read.rows);
  const std::vector<result::Explanation> expected = result::steps_to_explain(read.rows);
  ASSERT_EQ(written.size(), expected.size());
  ASSERT_FALSE(written.empty());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(written[i].step, expected[i].step);
    EXPECT_THAT(written[i].text,
                testing::StartsWith(fmt::format("vehicle {} ", expected[i].vehicle.value)));
    EXPECT_THAT(written[i].text, HasSubstr(fmt::format(", step {} (", expected[i].step)));
  }
  const auto has_explanations = [] {
    return read_file(run() / "run.html").find(R"("kind":"why")") != std::string::npos;
  };
  EXPECT_TRUE(has_explanations());
  const test::Outcome summarized = test::run_program("summarize --run " + run().string());
  EXPECT_EQ(summarized.exit_code, 0) << summarized.output;
  EXPECT_TRUE(has_explanations());
  write_file(record::explanations_file(run()), "step,vehicle,text\n1,200,of another run\n");
  const test::Outcome refused = test::run_program("summarize --run " + run().string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("explanations.csv:2: vehicle = \"200\", must be"));
  EXPECT_FALSE(fs::exists(run() / "run.html"));
  fs::remove(record::explanations_file(run()));
}

TEST_F(Explain, RefusesInOneLine) {
  struct Bad {
    std::string flags;
    std::string named;
  };
  for (const auto& [flags, named] :
       {Bad{"--vehicle_id 12 --step 3", "1, 2, 3, 4, 5"},
        Bad{"--vehicle_id 2 --step 12", "last is 11"}, Bad{"--vehicle_id 2", "--step"},
        Bad{"--all --step 2", "--all"}, Bad{"--all --tree", "--all"},
        Bad{"--vehicle_id 0 --step 1", "--vehicle_id"},
        Bad{"--vehicle_id 2 --step 1 --colour red", "--colour"},
        Bad{"--vehicle_id 2 --step 1 --dump_problems /proc/no",
            "folder of the planning problems"}}) {
    const auto [exit_code, output] = explain(flags);
    EXPECT_EQ(exit_code, 2) << flags << '\n' << output;
    EXPECT_THAT(output, HasSubstr(named));
    EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
  }
}

}  // namespace
}  // namespace hlc::apps
