// plan_problem, propose_budget and ompl_example as they are called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/planner/apps/deployed_program.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;
using test::DeployedProgram;
using test::Outcome;
using test::run_program;
using testing::HasSubstr;

const std::string kLaunch = test::source_folder() + "/launch_scripts/";
const std::string kShipped = kLaunch + "problems/parked_car.json";

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class ProblemPrograms : public testing::Test {
 protected:
  /// The shipped problem with one piece replaced, in the folder.
  [[nodiscard]] std::string changed(const std::string& from, const std::string& to) const {
    std::stringstream text;
    text << std::ifstream(kShipped).rdbuf();
    std::string problem = text.str();
    const auto replace = [&problem](const std::string& what, const std::string& with) {
      const std::size_t at = problem.find(what);
      EXPECT_NE(at, std::string::npos) << what;
      problem.replace(at, what.size(), with);
    };
    replace("../automata", kLaunch + "automata");
    replace(from, to);
    std::ofstream(folder_ / "problem.json") << problem;
    return (folder_ / "problem.json").string();
  }
  /// Everything is occupied in the first step.
  [[nodiscard]] std::string infeasible() const {
    return changed("\"obstacles\": [\n    [",
                   "\"obstacles\": [\n    [[[-9, -9], [9, -9], [0, 9]], ");
  }

  const test::TemporaryFolder folder_;
};

nlohmann::json json_of(const std::string& flags) {
  const Outcome outcome = run_program("plan_problem --json " + flags);
  const auto json = nlohmann::json::parse(outcome.output, nullptr, false);
  EXPECT_TRUE(json.is_object()) << outcome.output;
  return json;
}

TEST_F(ProblemPrograms, NoLineOfAPlanIsWiderThanANarrowTerminal) {
  EXPECT_NE(test::lines_beyond(60, run_program("plan_problem " + kShipped).output), "");
  const Outcome narrow = run_program("plan_problem " + kShipped, "COLUMNS=60 ");
  EXPECT_EQ(narrow.exit_code, 0) << narrow.output;
  EXPECT_EQ(test::lines_beyond(60, narrow.output), "");
  EXPECT_THAT(narrow.output, HasSubstr("\nstep ref_x [m] ref_y [m]  distance [m]\n"));
}

TEST_F(ProblemPrograms, TheJsonHoldsThePlan) {
  const auto json = json_of(kShipped);
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["reason"], "none");
  EXPECT_EQ(json["gap"], 0.0);
  EXPECT_GT(json["generated"], json["expanded"]);
  EXPECT_GT(json["planning_us"], 0.0);
  ASSERT_EQ(json["trims"].size(), 8U);
  ASSERT_EQ(json["poses"].size(), 8U);
  EXPECT_EQ(json["trims"].back(), 1) << "it ends standing";
  const std::vector<double> reference_x{0.16, 0.32, 0.48, 0.64, 0.80, 0.96, 1.12, 1.28};
  double cost_m2 = 0.0;
  for (std::size_t j = 0; j < 8; ++j) {
    ASSERT_EQ(json["poses"][j].size(), 3U);
    const double dx = json["poses"][j][0].get<double>() - reference_x[j];
    const double dy = json["poses"][j][1].get<double>();
    cost_m2 += dx * dx + dy * dy;
  }
  EXPECT_NEAR(json["cost"].get<double>(), cost_m2, 1e-9);
}

TEST_F(ProblemPrograms, EveryEngineAndBoundFindsTheSameCost) {
  const double cost_m2 = json_of(kShipped)["cost"].get<double>();
  for (const char* flags : {"--engine branch_and_bound", "--engine best_first",
                            "--engine best_first --cost_to_go reachable"}) {
    const auto json = json_of(kShipped + " " + flags);
    EXPECT_EQ(json["status"], "optimal") << flags;
    EXPECT_NEAR(json["cost"].get<double>(), cost_m2, 1e-9) << flags;
  }
}

TEST_F(ProblemPrograms, TheTableNamesStatusCostAndEveryStep) {
  const Outcome outcome = run_program("plan_problem " + kShipped);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* text : {"status           optimal", "cost ", "generated", "expanded",
                           "planning time", "\n   8     1  J2 "}) {
    EXPECT_THAT(outcome.output, HasSubstr(text));
  }
}

TEST_F(ProblemPrograms, WithoutAPlanTheStatusIsFallbackAndTheExitCode1) {
  const std::string problem = infeasible();
  const Outcome outcome = run_program("plan_problem " + problem);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("fallback: infeasible"));
  const auto json = json_of(problem);
  EXPECT_EQ(json["status"], "fallback");
  EXPECT_EQ(json["reason"], "infeasible");
  EXPECT_TRUE(json["cost"].is_null());
  EXPECT_TRUE(json["trims"].empty());
  EXPECT_EQ(json_of(kShipped + " --max_expansions 1")["reason"], "budget");
}

TEST_F(ProblemPrograms, BadInputIsOneLineAndExitCode2) {
  const std::string unknown = changed("\"psi\": 0", "\"phi\": 0");
  for (const std::string& flags :
       {std::string("/nowhere.json"), unknown, kShipped + " --engine fast",
        kShipped + " --engine branch_and_bound --cost_to_go 2022", kShipped + " --max_expansions 0",
        kShipped + " --max_expansions -5", kShipped + " --max_expansions 99999999999999999999999",
        kShipped + " --automaton /nowhere.yaml", kShipped + " --unknown", std::string()}) {
    const Outcome outcome = run_program("plan_problem " + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_EQ(lines_of(outcome.output), 1U) << outcome.output;
  }
  EXPECT_THAT(run_program("plan_problem " + unknown).output,
              HasSubstr("problem.json: start.phi = 0, unknown key; known keys: x, y, psi, trim"));
}

TEST_F(ProblemPrograms, TheNameOfAFileStaysInOneLine) {
  const Outcome outcome = run_program("plan_problem \"$(printf '/no\\nwhere\\033[31m')\"");
  EXPECT_EQ(outcome.output,
            "plan_problem: /no\\nwhere\\x1b[31m: cannot be read, must be a JSON file\n");
}

TEST_F(ProblemPrograms, TheDrawingHasTheProblemAndItsPlanOrTheReason) {
  const DeployedProgram program("plan_problem");
  ASSERT_EQ(program.run(kShipped).exit_code, 0);
  EXPECT_EQ(program.kind(), "problem");
  const nlohmann::json drawn = program.drawn();
  const auto plan = json_of(kShipped);
  EXPECT_EQ(drawn["status"], plan["status"]);
  EXPECT_EQ(drawn["cost_m2"], plan["cost"]);
  ASSERT_EQ(drawn["vehicles"].size(), 1U);
  const nlohmann::json& vehicle = drawn["vehicles"][0];
  EXPECT_EQ(vehicle["poses"], plan["poses"]);
  for (const char* of_each_step : {"reference", "obstacles", "swept"}) {
    EXPECT_EQ(vehicle[of_each_step].size(), drawn["horizon_steps"]) << of_each_step;
  }
  EXPECT_GT(vehicle["boundary"].size(), 0U);
  EXPECT_EQ(program.run(infeasible()).exit_code, 1);
  EXPECT_EQ(program.drawn()["reason"], "infeasible");
  EXPECT_EQ(program.drawn()["vehicles"][0]["poses"].size(), 0U);
  program.remove_script();
  EXPECT_EQ(program.run(kShipped).exit_code, 3);
}

TEST_F(ProblemPrograms, TheTreeIsAPageOfThePlanThatThePlainEngineFinds) {
  const std::string page = (folder_ / "tree.html").string();
  const Outcome outcome = run_program("plan_problem " + kShipped + " --tree " + page);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("engine           best_first"));
  std::stringstream text;
  text << std::ifstream(page).rdbuf();
  for (const char* word : {"<!doctype html>", "Runner-up: ", "The search tree", "</html>"}) {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
  EXPECT_EQ(run_program("plan_problem " + infeasible() + " --tree " + page).exit_code, 1);
}

TEST_F(ProblemPrograms, TheTreeAsJsonHasEveryVertexAndTheCountsOfTheSearch) {
  const fs::path file = folder_ / "tree.json";
  const auto plan = json_of(kShipped + " --tree " + file.string());
  const auto tree = nlohmann::json::parse(std::ifstream(file), nullptr, false);
  for (const char* key : {"status", "cost", "lower_bound", "trims", "generated", "expanded"}) {
    EXPECT_EQ(tree[key], plan[key]) << key;
  }
  ASSERT_EQ(tree["vertices"].size(), plan["generated"]);
  EXPECT_EQ(tree["vertices_left_out"], 0);
  std::size_t expanded = 0;
  for (const auto& depth : tree["depths"]) expanded += depth["expanded"].get<std::size_t>();
  EXPECT_EQ(expanded, plan["expanded"]);
  for (const auto& vertex : tree["vertices"]) {
    EXPECT_EQ(vertex["fate"] == "collision", !vertex["obstruction"].is_null());
    EXPECT_EQ(vertex["parent"].is_null(), vertex["depth"] == 0);
  }
  const auto& second = tree["alternatives"][tree["runner_up"].get<std::size_t>()];
  for (const auto& one : tree["alternatives"]) EXPECT_GE(one["extra"], second["extra"]);
  EXPECT_NEAR(second["cost"].get<double>() - plan["cost"].get<double>(),
              second["extra"].get<double>(), 1e-9);
}

TEST_F(ProblemPrograms, ATreeIsRefusedWhereItCannotBeRecorded) {
  const std::string page = (folder_ / "tree.html").string();
  for (const auto& [flags, error] : std::vector<std::pair<std::string, std::string>>{
           {"--tree " + (folder_ / "tree.svg").string(), "must end in .html or .json"},
           {"--tree " + page + " --engine branch_and_bound",
            "--engine = branch_and_bound with --tree, must be best_first"},
           {"--tree " + page + " --engine best_first --cost_to_go 2022",
            "cost_to_go = 2022, must be reachable or straight_line for a search tree"},
           {"--tree " + page + " --plot " + page, "must be a file other than"},
           {"--tree /nowhere/tree.html", "must be"}}) {
    const Outcome outcome = run_program("plan_problem " + kShipped + " " + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_EQ(lines_of(outcome.output), 1U) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(error));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(ProblemPrograms, APictureNeverTakesThePlaceOfItsProblem) {
  const std::string problem = infeasible();
  const auto size = fs::file_size(problem);
  const Outcome outcome = run_program("plan_problem " + problem + " --plot " + problem);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("must be a file other than the input"));
  EXPECT_EQ(fs::file_size(problem), size);
}

TEST_F(ProblemPrograms, NorThatOfTheAutomatonThatIsReadForIt) {
  const std::string automaton = (folder_ / "automaton.yaml").string();
  fs::copy_file(kLaunch + "automata/paper.yaml", automaton);
  const auto size = fs::file_size(automaton);
  for (const std::string& command :
       {"plan_problem " + kShipped + " --automaton " + automaton + " --plot " + automaton,
        "plan_problem " + changed(kLaunch + "automata/paper.yaml", automaton) + " --plot " +
            automaton,
        "ompl_example " + changed(kLaunch + "automata/paper.yaml", automaton) + " --log " +
            automaton}) {
    const Outcome outcome = run_program(command);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("must be a file other than the input"));
    EXPECT_EQ(fs::file_size(automaton), size);
  }
}

TEST_F(ProblemPrograms, ABudgetIsProposedAsANumberForTheScenario) {
  const std::string command = "propose_budget --scenario " + kLaunch +
                              "scenarios/paper_red_alone.yaml --steps 3 --engine best_first";
  const Outcome outcome = run_program(command + " --deadline_ms 1000");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("engine best_first"));
  EXPECT_THAT(outcome.output, HasSubstr("all ends blocked"));
  const std::string key = "max_expansions: ";
  const std::size_t at = outcome.output.find(key);
  ASSERT_NE(at, std::string::npos) << outcome.output;
  EXPECT_GT(std::stoul(outcome.output.substr(at + key.size())), 100U);
  EXPECT_EQ(run_program(command + " --deadline_ms 0.001 --safety 1000").exit_code, 1);
  for (const char* bad : {"never", "nan", "inf"}) {
    EXPECT_EQ(run_program(command + " --deadline_ms " + bad).exit_code, 2) << bad;
  }
  EXPECT_EQ(run_program(command).exit_code, 2);
  const Outcome profile = run_program(
      "propose_budget " + kLaunch +
      "scenarios/paper_red_alone.yaml --deadline_ms 9 --profile 2022 --engine branch_and_bound");
  EXPECT_EQ(profile.exit_code, 2);
  EXPECT_THAT(profile.output, HasSubstr("--engine = branch_and_bound with profile 2022, must be"));
}

TEST_F(ProblemPrograms, TheOmplExampleComparesPlannersAndWritesOnlyWhereItIsTold) {
  const std::string command = "ompl_example " + kShipped + " --time_s 0.02 --runs 2";
  const Outcome outcome = run_program(command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* planner :
       {"this planner, branch_and_bound", "this planner, best_first", "RRT", "SST", "KPIECE1"}) {
    EXPECT_THAT(outcome.output, HasSubstr(std::string("\n") + planner));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  const fs::path log = folder_ / "benchmark.log";
  EXPECT_EQ(run_program(command + " --log " + log.string()).exit_code, 0);
  EXPECT_GT(fs::file_size(log), 1000U);
  EXPECT_EQ(run_program("ompl_example /nowhere.json").exit_code, 2);
  EXPECT_EQ(run_program(command + " --log " + (folder_ / "missing/log").string()).exit_code, 2);
  EXPECT_EQ(run_program("ompl_example " + kShipped + " --time_s nan").exit_code, 2);
}

TEST_F(ProblemPrograms, TheOmplExampleSaysWhatItsPlansAreAndWhatPlannerDataHolds) {
  const std::string command = "ompl_example --time_s 0.02 --runs 1 ";
  const Outcome outcome = run_program(command + kShipped);
  for (const char* text : {" optimal\n",
                           "PlannerData of this planner, branch_and_bound: 9 vertices, "
                           "8 edges\n  vertex 0: x 0.000 m",
                           "trim 7, start\n", "trim 1, goal\n"}) {
    EXPECT_THAT(outcome.output, HasSubstr(text));
  }
  const std::string budget =
      changed("\"step_s\"", "\"search\": {\"max_expansions\": 20}, \"step_s\"");
  EXPECT_THAT(run_program(command + "--radius_m 5 " + budget).output,
              HasSubstr(" best so far\nthis planner, best_first"));
  EXPECT_THAT(run_program("ompl_example --help").output,
              HasSubstr("--seed UINT:1 ... 1073741824=1"));
}

TEST_F(ProblemPrograms, TheOmplExampleRefusesWhatItsObjectiveDoesNotHold) {
  const std::string weights =
      changed("\"step_s\"", R"("search": {"criterion_weights": {"J2": 0.5}}, "step_s")");
  const Outcome outcome = run_program("ompl_example " + weights);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(lines_of(outcome.output), 1U) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("problem.json: search.criterion_weights.J2 = 0.5, must be absent"));
}

TEST_F(ProblemPrograms, TheOmplExampleEndsAlsoWhenASearchDoesNot) {
  std::ofstream problem(folder_ / "endless.json");
  problem << R"({"automaton": ")" << kLaunch
          << R"(automata/paper.yaml", "subgraph": "D", "step_s": 0.2,
    "horizon_steps": 64, "start": {"x": 0, "y": 0, "psi": 0, "trim": 1},
    "search": {"max_expansions": 1000000000000}, "reference": [[0, 0])";
  for (int j = 1; j < 64; ++j) problem << ", [" << 0.1 * j << ", 0]";
  problem << "], \"obstacles\": [";
  for (int j = 1; j < 64; ++j) problem << "[], ";
  problem << "[[[-99, -99], [99, -99], [99, 99], [-99, 99]]]]}";
  problem.close();
  const Outcome outcome =
      run_program("ompl_example --time_s 0.02 --runs 1 " + (folder_ / "endless.json").string());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("branch_and_bound alone: more than 0.02 s\n"));
  EXPECT_THAT(outcome.output, HasSubstr("branch_and_bound: 0 vertices, 0 edges\n"));
}

}  // namespace
}  // namespace hlc::apps
