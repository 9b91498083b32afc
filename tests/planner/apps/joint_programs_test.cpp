// plan_problem with joint problems, and price_of_priority, as they are called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "planner/common/csv.hpp"
#include "tests/planner/apps/deployed_program.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps::joint_programs_test {
namespace {

using test::Outcome;
using test::run_program;
using testing::HasSubstr;

const std::string kLaunch = test::source_folder() + "/launch_scripts/";
const std::string kCrossing = kLaunch + "problems/two_at_a_crossing.json";
const std::string kScenario = kLaunch + "scenarios/paper_three_cars.yaml";

std::string text_of(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

nlohmann::json json_of(const std::string& flags) {
  const Outcome outcome = run_program("plan_problem --json " + flags);
  auto json = nlohmann::json::parse(outcome.output, nullptr, false);
  EXPECT_TRUE(json.is_object()) << outcome.output;
  return json;
}

TEST(JointPrograms, PlanProblemSolvesAJointProblem) {
  const nlohmann::json json = json_of(kCrossing);
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["gap"], 0.0);
  ASSERT_EQ(json["vehicles"].size(), 2U);
  double sum_m2 = 0.0;
  for (const auto& vehicle : json["vehicles"]) {
    sum_m2 += vehicle["cost"].get<double>();
    EXPECT_EQ(vehicle["trims"].size(), 8U);
    EXPECT_EQ(vehicle["poses"].size(), 8U);
    EXPECT_EQ(vehicle["trims"].back(), 1) << "it ends standing";
  }
  EXPECT_NEAR(json["cost"].get<double>(), sum_m2, 1e-9);
  EXPECT_LT(json["alone"], json["cost"]);
  EXPECT_LT(json["cost"], json["best_order"]);
  EXPECT_LT(json["best_order"], json["constant_order"]);
  EXPECT_NEAR(json_of(kCrossing + " --engine best_first")["cost"].get<double>(), sum_m2, 1e-9);
  const nlohmann::json hurried = json_of(kCrossing + " --max_expansions 1");
  EXPECT_EQ(hurried["status"], "budget");
  EXPECT_EQ(hurried["cost"], json["best_order"]);
  EXPECT_LE(hurried["lower_bound"], json["cost"]);
}

TEST(JointPrograms, TheDrawingHasEachVehicle) {
  const test::DeployedProgram program("plan_problem");
  const Outcome outcome = program.run(kCrossing);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* text : {"status           optimal", "best order", "jointly", "alone"}) {
    EXPECT_THAT(outcome.output, HasSubstr(text));
  }
  const nlohmann::json vehicles = program.drawn()["vehicles"];
  ASSERT_EQ(vehicles.size(), 2U);
  EXPECT_EQ(vehicles[1]["poses"].size(), 8U);
  EXPECT_NE(vehicles[0]["start"], vehicles[1]["start"]);
}

TEST(JointPrograms, BadInputIsOneLineAndExitCode2) {
  const test::TemporaryFolder folder;
  for (const std::string& command :
       {"plan_problem " + kCrossing + " --tree " + (folder / "tree.html").string(),
        "plan_problem " + kCrossing + " --engine best_first --cost_to_go 2022",
        "plan_problem " + kCrossing + " --plot " + kCrossing,
        "price_of_priority " + kScenario + " --cars 1",
        "price_of_priority " + kScenario + " --cars 5",
        "price_of_priority " + kScenario + " --budgets 0",
        "price_of_priority " + kScenario + " --fast",
        "price_of_priority " + kScenario + " --dump_problems " + test::source_folder(),
        "price_of_priority " + kScenario + " --table /nowhere/rows.csv",
        std::string("price_of_priority /nowhere.yaml"),
        "price_of_priority " + kLaunch + "scenarios/grid_red_alone.yaml --problems 1 --cars 4x"}) {
    const Outcome outcome = run_program(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << command << "\n" << outcome.output;
  }
}

TEST(JointPrograms, ThePriceOfPriorityIsThatOfTheDumpedProblems) {
  const test::TemporaryFolder folder;
  const std::string rows_file = (folder / "rows.csv").string();
  const std::string dump = (folder / "problems").string();
  const Outcome outcome =
      run_program("price_of_priority " + kScenario + " --problems 12 --seed 4 --budgets 1,100000" +
                  " --table " + rows_file + " --dump_problems " + dump);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* rule : {"constant", "most collisions first", "best of all orders",
                           "and 1 joint expansions", "and 100000 joint expansions"}) {
    EXPECT_THAT(outcome.output, HasSubstr(rule));
  }
  const CsvTable rows(rows_file, "problem,rule,cost_m2,optimum_m2,is_proven");
  ASSERT_EQ(rows.size(), 12U * 5U);
  std::size_t num_proven = 0;
  for (std::size_t i = 0; i < rows.size(); i += 5) {
    if (rows.unsigned_number(i, 4) == 0) continue;
    ++num_proven;
    const double optimum_m2 = rows.number(i, 3);
    for (std::size_t rule = 0; rule < 5; ++rule) {
      if (rows.text(i + rule, 2).empty()) continue;
      EXPECT_GE(rows.number(i + rule, 2), optimum_m2 * (1.0 - 1e-8));
    }
    const std::string number = std::to_string(10001 + i / 5).substr(1);
    EXPECT_NEAR(json_of(dump + "/problem_" + number + ".json")["cost"].get<double>(), optimum_m2,
                1e-8 * optimum_m2);
  }
  EXPECT_GT(num_proven, 4U);
  const Outcome again =
      run_program("price_of_priority " + kScenario +
                  " --problems 12 --seed 4 --budgets 1,100000 --table " + rows_file + "2");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(text_of(rows_file + "2"), text_of(rows_file));
}

}  // namespace
}  // namespace hlc::apps::joint_programs_test
