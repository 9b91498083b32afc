// The evaluation program: files, resumption, invalid input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "planner/common/csv.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/vehicle_sim/apps/timeless_results.hpp"

namespace hlc::test {
namespace {

using testing::HasSubstr;

const std::string kScenarios =
    std::string(" --scenario_folder ") + test::source_folder() + "/launch_scripts/scenarios";

std::string text_of(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class Evaluate : public testing::Test {
 protected:
  [[nodiscard]] Outcome evaluate(const std::string& flags) const {
    return run_program("evaluate --scenario paper_red_alone --subgraphs B,D --starts 2 --steps 20" +
                       kScenarios + " --out " + out_.string() + " " + flags);
  }
  [[nodiscard]] nlohmann::json results() const { return rows_of(out_); }
  [[nodiscard]] CsvTable table(const std::string& name) const { return CsvTable(out_ / name); }

  TemporaryFolder folder_;
  std::filesystem::path out_{folder_ / "campaign"};
};

TEST_F(Evaluate, WritesOneRowPerRunAndOnePerRunAndCar) {
  const Outcome done = evaluate("--jobs 2");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const nlohmann::json runs = results()["runs"];
  ASSERT_EQ(runs.size(), 4U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i]["run"], i);
    EXPECT_EQ(runs[i]["start"], i % 2);
    EXPECT_EQ(runs[i]["subgraph"], i < 2 ? "B" : "D");
    EXPECT_EQ(runs[i]["steps"], 20);
    EXPECT_TRUE(runs[i]["failure"].is_null());
  }
  const CsvTable rows = table("runs.csv");
  const CsvTable cars = table("cars.csv");
  ASSERT_EQ(rows.size(), 4U);
  ASSERT_EQ(cars.size(), 4U);
  const auto column = [&](const CsvTable& of, const char* name) { return of.find(name).value(); };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(rows.unsigned_number(i, column(rows, "run")), i);
    EXPECT_EQ(rows.text(i, column(rows, "subgraph")), i < 2 ? "B" : "D");
    EXPECT_EQ(rows.text(i, column(rows, "policy")), "none");
    EXPECT_EQ(rows.text(i, column(rows, "failure")), "");
    EXPECT_EQ(rows.text(i, column(rows, "lap_s")), "") << "20 steps are no lap";
    EXPECT_EQ(rows.number(i, column(rows, "share.D")), i < 2 ? 0.0 : 1.0);
    for (const char* name : {"error_mean_mm", "generated_max", "planning_max_ms", "wall_s"}) {
      EXPECT_EQ(rows.number(i, column(rows, name)), runs[i]["figures"][name]) << name;
    }
    EXPECT_EQ(cars.text(i, column(cars, "name")), "red");
    EXPECT_EQ(cars.number(i, column(cars, "error_mean_mm")),
              runs[i]["vehicles"][0]["reference_error_mm"]["mean"]);
    EXPECT_EQ(cars.text(i, column(cars, "is_stuck")), "false");
  }
  const auto campaign = nlohmann::json::parse(text_of(out_ / "campaign.json"));
  EXPECT_EQ(campaign["kind"], "campaign");
  EXPECT_EQ(campaign["campaign"], results()["campaign"]);
  EXPECT_THAT(campaign["origin"]["command"].get<std::string>(), HasSubstr("--subgraphs B,D"));
}

TEST_F(Evaluate, GoesOnWhereItWasInterrupted) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  const nlohmann::json whole = timeless(results());
  const std::string lines = text_of(out_ / "runs.jsonl");
  // Killed while it wrote the third run.
  std::size_t cut = 0;
  for (int line = 0; line < 3; ++line) cut = lines.find('\n', cut) + 1;
  put(out_ / "runs.jsonl", lines.substr(0, cut + 40));
  const auto rows = timeless_table(out_ / "runs.csv");
  std::filesystem::remove(out_ / "runs.csv");
  const Outcome again = evaluate("");
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("2 of 4 runs already driven"));
  EXPECT_EQ(timeless(results()), whole);
  EXPECT_EQ(timeless_table(out_ / "runs.csv"), rows);
}

TEST_F(Evaluate, DrivesMoreCarsThanTheLabHas) {
  const Outcome outcome = run_program("evaluate --scenario lab_cars --cars 40 --steps 5" +
                                      kScenarios + " --out " + out_.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(results()["runs"][0]["vehicles"].size(), 40U);
}

TEST_F(Evaluate, DrawsOtherCarsForEveryStartAndKeepsTheDraw) {
  const Outcome outcome = run_program(
      "evaluate --scenario lab_cars --cars 3 --routes random --starts 2 --steps 10 --keep_runs" +
      kScenarios + " --out " + out_.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json runs = results()["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["vehicles"].size(), 3U);
  EXPECT_NE(runs[0]["vehicles"][0]["name"], runs[1]["vehicles"][0]["name"]);
  for (const char* seed : {"1", "2"}) {
    const std::filesystem::path run = out_ / "runs" / (seed[0] == '1' ? "0" : "1");
    EXPECT_THAT(text_of(run / "configuration" / "flags.yaml"),
                HasSubstr(std::string("cars: 3\nseed: ") + seed + "\nroutes: \"random\"\n"));
    EXPECT_EQ(run_program("export_commonroad --run " + run.string() + " --out " +
                          (folder_ / "run.xml").string())
                  .exit_code,
              0);
  }
}

TEST_F(Evaluate, RefusesAFolderThatHoldsSomethingElseAndLeavesItAlone) {
  std::filesystem::create_directory(out_);
  put(out_ / "thesis.tex", "text");
  const Outcome outcome = evaluate("");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("contains other files"));
  EXPECT_EQ(text_of(out_ / "thesis.tex"), "text");
  EXPECT_FALSE(std::filesystem::exists(out_ / "runs.jsonl"));
}

TEST_F(Evaluate, RefusesTheFolderOfAnotherCampaign) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  const std::string before = text_of(out_ / "runs.jsonl");
  const Outcome outcome = evaluate("--seed 2");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("other choices"));
  EXPECT_THAT(outcome.output, HasSubstr("there: seed 1)"));
  EXPECT_EQ(text_of(out_ / "runs.jsonl"), before);
}

TEST_F(Evaluate, RefusesToGoOnAfterAutomatonOrMapHaveChanged) {
  const std::string source = test::source_folder() + "/launch_scripts/";
  for (const char* file :
       {"scenarios/paper_red_alone.yaml", "automata/paper.yaml", "maps/lab_like.xml"}) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    put(folder_ / file, text_of(source + file));
  }
  const auto run = [&] {
    return run_program("evaluate --steps 20 --scenario " +
                       (folder_ / "scenarios" / "paper_red_alone.yaml").string() + " --out " +
                       out_.string());
  };
  ASSERT_EQ(run().exit_code, 0);
  const std::string before = text_of(out_ / "runs.jsonl");
  for (const auto& [file, comment] : {std::pair{"automata/paper.yaml", "# another\n"},
                                      {"maps/lab_like.xml", "<!-- another -->\n"}}) {
    const std::string text = text_of(folder_ / file);
    put(folder_ / file, text + comment);
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 2) << file;
    EXPECT_THAT(outcome.output,
                HasSubstr("there: files " + std::filesystem::path(file).filename().string() + ")"));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_EQ(text_of(out_ / "runs.jsonl"), before);
    put(folder_ / file, text);
  }
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(Evaluate, RefusesAFolderInWhichSomebodyElseWrote) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  const std::string before = text_of(out_ / "runs.jsonl");
  put(out_ / "runs.jsonl", before + "by hand\n");
  const Outcome broken = evaluate("");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.output, HasSubstr("line 6 of runs.jsonl"));
  EXPECT_EQ(text_of(out_ / "runs.jsonl"), before + "by hand\n");
  for (const auto& [was, is] : {std::pair{"\"run\":3", "\"run\":99"},
                                {"\"run\":3", "\"run\":-1"},
                                {"\"run\":3", "\"run\":1.7"},
                                {"\"failure\"", "\"fault\""},
                                {"\"figures\"", "\"numbers\""},
                                {"\"generated_max\":", "\"generated_max\":\"many\",\"x\":"}}) {
    SCOPED_TRACE(is);
    std::string damaged = before;
    damaged.replace(damaged.rfind(was), std::string(was).size(), is);
    put(out_ / "runs.jsonl", damaged);
    const Outcome refused = evaluate("");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("runs.jsonl"));
    EXPECT_EQ(std::ranges::count(refused.output, '\n'), 1) << refused.output;
    EXPECT_EQ(text_of(out_ / "runs.jsonl"), damaged);
  }
  put(out_ / "runs.jsonl", before);
  put(out_ / "series", "a file");
  const Outcome no_folder = evaluate("--series");
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.output, HasSubstr("series must be a folder"));
  EXPECT_EQ(text_of(out_ / "series"), "a file");
}

TEST_F(Evaluate, SharesOfTheWallTimeAreInTheRecords) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  const nlohmann::json written = results();
  for (const nlohmann::json& run : written["runs"]) {
    double sum_s = 0.0;
    for (const char* part : {"wall_planning_s", "wall_coordination_s", "wall_vehicles_s"}) {
      const double share_s = run["figures"][part];
      EXPECT_GT(share_s, 0.0) << part;
      sum_s += share_s;
    }
    EXPECT_LE(sum_s, run["wall_s"]);
  }
}

TEST_F(Evaluate, WritesTheSeriesOfTheFiguresAlsoLater) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(out_ / "series"));
  const Outcome later = evaluate("--series --jobs 2");
  EXPECT_EQ(later.exit_code, 0) << later.output;
  EXPECT_THAT(later.output, HasSubstr("4 of 4 runs already driven"));
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(out_ / "series")) {
    files.insert(entry.path().filename());
  }
  EXPECT_EQ(files,
            (std::set<std::string>{"steps.csv", "drives.csv", "distances.csv", "places.json"}));
  const std::string steps = text_of(out_ / "series" / "steps.csv");
  EXPECT_EQ(std::ranges::count(steps, '\n'), 1 + 4 * 20);
  const auto places = nlohmann::json::parse(text_of(out_ / "series" / "places.json"));
  ASSERT_EQ(places["runs"].size(), 4U);
  EXPECT_EQ(places["runs"][3]["subgraph"], "D");
  EXPECT_EQ(places["runs"][3]["start"], 1);
  EXPECT_EQ(places["runs"][3]["fault"], "");
  ASSERT_EQ(places["scenarios"].size(), 1U);
  const nlohmann::json& scenario = places["scenarios"][0];
  EXPECT_EQ(scenario["vehicles"].size(), 1U);
  EXPECT_GT(scenario["lanelets"].size(), 10U);
  EXPECT_GT(scenario["vehicles"][0]["path"]["length_m"], 1.0);
}

// The motor of the first scenario's vehicle is too weak for its plans.
TEST_F(Evaluate, ARunThatFailsIsRecordedWithItsReasonAndDoesNotStopTheOthers) {
  const std::string sources = test::source_folder() + "/launch_scripts/";
  std::string text = text_of(sources + "automata/paper.yaml");
  const std::string before = "  width_m: 0.107\n";
  text.insert(text.find(before), "  identified: {thrust_offset_mps2: -18.6}\n");
  put(folder_ / "weak.yaml", text);
  text = text_of(sources + "scenarios/paper_red_alone.yaml");
  const std::string automaton = "../automata/paper.yaml";
  text.replace(text.find(automaton), automaton.size(), "weak.yaml");
  const std::string map = "../maps/lab_like.xml";
  text.replace(text.find(map), map.size(), sources + "maps/lab_like.xml");
  const std::string name = "name: paper_red_alone";
  text.replace(text.find(name), name.size(), "name: weak_motor");
  put(folder_ / "weak_motor.yaml", text);
  const Outcome done =
      run_program("evaluate --scenario " + (folder_ / "weak_motor.yaml").string() +
                  ",paper_red_alone --steps 20" + kScenarios + " --out " + out_.string());
  EXPECT_EQ(done.exit_code, 1) << done.output;
  EXPECT_THAT(done.output, HasSubstr("2 runs, 1 failed"));
  const nlohmann::json runs = results()["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_THAT(runs[0]["failure"].get<std::string>(), HasSubstr("left its announced areas"));
  EXPECT_EQ(runs[0]["subgraph"], "B");
  EXPECT_TRUE(runs[1]["failure"].is_null());
  const CsvTable rows = table("runs.csv");
  EXPECT_THAT(rows.text(0, rows.find("failure").value()), HasSubstr("left its announced areas"));
  EXPECT_EQ(rows.text(1, rows.find("failure").value()), "");
}

TEST_F(Evaluate, AMapThatCannotBeReadIsBadInput) {
  const std::filesystem::path scenario = folder_ / "own.yaml";
  std::string text =
      text_of(test::source_folder() + "/launch_scripts/scenarios/paper_red_alone.yaml");
  const std::string automaton = "../automata/paper.yaml";
  text.replace(text.find(automaton), automaton.size(),
               test::source_folder() + "/launch_scripts/automata/paper.yaml");
  const std::string map = "../maps/lab_like.xml";
  text.replace(text.find(map), map.size(), "map.xml");
  put(scenario, text);
  for (const char* content : {"", "<commonRoad", "<other/>"}) {
    if (*content != '\0') put(folder_ / "map.xml", content);  // first: no such file
    const Outcome outcome =
        run_program("evaluate --scenario " + scenario.string() + " --out " + out_.string());
    EXPECT_EQ(outcome.exit_code, 2) << content;
    EXPECT_THAT(outcome.output, HasSubstr("map.xml"));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
}

TEST_F(Evaluate, NamesWhatItDoesNotKnow) {
  for (const auto& [flags, message] : {std::pair{"--profile 2021", "2021"},
                                       {"--scenario nowhere", "--scenario = nowhere"},
                                       {"--subgraphs Z", "Z"},
                                       {"--subgraphs B,D,B", "--subgraphs = B twice"},
                                       {"--policies zone", "--policies = zone, must be one of"},
                                       {"--policies zone,zone", "--policies = zone twice"},
                                       {"--profile 2022,2022", "--profile = 2022 twice"},
                                       {"--scenario circle,circle", "--scenario = circle twice"},
                                       {"--starts 0", "--starts"},
                                       {"--starts 2.5", "--starts"},
                                       {"--seed -5", "--seed"},
                                       {"--cars 3", "--cars"},
                                       {"--routes some", "--routes"},
                                       {"--noise_seed 99999999999999999999999", "--noise_seed"},
                                       {"--figures paths", "--figures"},
                                       {"--unheard_of", "unheard_of"}}) {
    const Outcome outcome =
        run_program(std::string("evaluate --out ") + out_.string() + kScenarios + " " + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(out_)) << flags;
  }
}

/// Three cars on fixed subgraphs and with policies.
class EvaluatePolicies : public Evaluate {
 protected:
  [[nodiscard]] Outcome drive(const std::string& flags) const {
    return run_program("evaluate --scenario reconfiguration --steps 20" + kScenarios + " --out " +
                       out_.string() + " " + flags);
  }
};

TEST_F(EvaluatePolicies, AreInRecordsAndTables) {
  const Outcome done = drive("--subgraphs J2,comfort --policies zone,situation --jobs 2");
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const nlohmann::json written = results();
  EXPECT_EQ(written["campaign"]["policies"], (nlohmann::json{"zone", "situation"}));
  const nlohmann::json& runs = written["runs"];
  ASSERT_EQ(runs.size(), 4U);
  const char* const kSubgraphs[] = {"J2", "comfort", "J2", "J2"};
  const char* const kPolicies[] = {"none", "none", "zone", "situation"};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i]["subgraph"], kSubgraphs[i]);
    EXPECT_EQ(runs[i]["policy"], kPolicies[i]);
    EXPECT_TRUE(runs[i]["figures"]["effort_per_m"].is_number());
    double shares = 0.0;
    for (const auto& [name, share] : runs[i]["figures"]["subgraph_shares"].items()) {
      shares += share.get<double>();
    }
    EXPECT_NEAR(shares, 1.0, 1e-12);
    EXPECT_TRUE(i >= 2 || runs[i]["figures"]["switches"] == 0);
  }
  const CsvTable rows = table("runs.csv");
  const CsvTable cars = table("cars.csv");
  EXPECT_EQ(cars.size(), 12U) << "three cars";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(rows.text(i, rows.find("policy").value()), runs[i]["policy"]);
    EXPECT_EQ(cars.text(3 * i, cars.find("policy").value()), runs[i]["policy"]);
  }
}

TEST_F(EvaluatePolicies, GoOnWhereTheyWereInterruptedInTheirOwnFolderOnly) {
  ASSERT_EQ(drive("").exit_code, 0);
  const std::string without = text_of(out_ / "runs.jsonl");
  const Outcome other = drive("--policies zone");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.output, HasSubstr("(there: policies [])"));
  EXPECT_EQ(text_of(out_ / "runs.jsonl"), without);
  EXPECT_THAT(drive("").output, HasSubstr("1 of 1 runs already driven"));

  std::filesystem::remove_all(out_);
  ASSERT_EQ(drive("--policies zone").exit_code, 0);
  const nlohmann::json whole = timeless(results());
  const std::string lines = text_of(out_ / "runs.jsonl");
  // Killed while it wrote the run that ended last; runs stand in the order in which they ended.
  std::size_t cut = 0;
  for (int line = 0; line < 2; ++line) cut = lines.find('\n', cut) + 1;
  put(out_ / "runs.jsonl", lines.substr(0, cut + 40));
  const Outcome again = drive("--policies zone");
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("1 of 2 runs already driven"));
  EXPECT_EQ(timeless(results()), whole);
  EXPECT_THAT(drive("").output, HasSubstr("(there: policies [\"zone\"])"));
}

TEST_F(EvaluatePolicies, AreRefusedByTheirFlagWithThoseThatThereAre) {
  for (const auto& [flags, message] :
       {std::pair{"--policies zones",
                  "reconfiguration.yaml: look_ahead, mixed, situation, time, zone, "
                  "zone_look_ahead, zone_reference\n"},
        {"--policies none", "(fixed subgraphs, --subgraphs, are driven without one)\n"},
        {"--policies zone --scenario paper_red_alone", "paper_red_alone.yaml: it has none\n"}}) {
    const Outcome outcome = drive(flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_THAT(outcome.output, HasSubstr("--policies = "));
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(out_)) << flags;
  }
}

TEST_F(EvaluatePolicies, RunFoldersAndSeriesNameTheOneThatDrove) {
  ASSERT_EQ(drive("--policies zone --keep_runs --series").exit_code, 0);
  for (const auto& [run, policy] : {std::pair{"0", "none"}, {"1", "zone"}}) {
    EXPECT_THAT(text_of(out_ / "runs" / run / "configuration" / "flags.yaml"),
                HasSubstr(std::string("policy: \"") + policy + "\"\n"));
  }
  EXPECT_THAT(text_of(out_ / "series" / "steps.csv"),
              HasSubstr("\n1,reconfiguration,default,J2,zone,0,"));
  const auto places = nlohmann::json::parse(text_of(out_ / "series" / "places.json"));
  EXPECT_EQ(places["scenarios"][0]["zones"]["zone"][0]["max_speed_mps"], 0.6);
}

TEST_F(Evaluate, KeepsRunFoldersThatTheExportAndTheSummaryRead) {
  ASSERT_EQ(evaluate("--keep_runs").exit_code, 0);
  const std::filesystem::path run = out_ / "runs" / "2";  // subgraph D, where the scenario starts
  const std::string out = (folder_ / "run.xml").string();
  const Outcome exported = run_program("export_commonroad --run " + run.string() + " --out " + out);
  EXPECT_EQ(exported.exit_code, 0) << exported.output;
  EXPECT_THAT(text_of(out), HasSubstr("<planningProblem id=\"1000001\">"));
  const Outcome summary =
      run_program("summarize --subgraph D --run " + run.string() + " --scenario " + run.string() +
                  "/configuration/scenarios/paper_red_alone.yaml");
  EXPECT_EQ(summary.exit_code, 0) << summary.output;
  const auto json = nlohmann::json::parse(text_of(run / "summary.json"));
  EXPECT_EQ(json["trace_sha256"], results()["runs"][2]["trace_sha256"]);
}

/// A run of 20 steps of paper_red_alone, on subgraph D, and its summary.
class SummaryOfARun : public Evaluate {
 protected:
  void SetUp() override { ASSERT_EQ(evaluate("--keep_runs").exit_code, 0); }

  [[nodiscard]] Outcome summarize(const std::string& flags = "") const {
    return run_program("summarize --run " + run_.string() + " " + flags);
  }
  /// Leaves the first half of a file of the run.
  void cut(const std::string& name) const {
    const std::string text = text_of(run_ / name);
    put(run_ / name, text.substr(0, text.size() / 2));
  }

  std::filesystem::path run_{out_ / "runs" / "2"};
  std::filesystem::path page_{run_ / "run.html"};
};

TEST_F(SummaryOfARun, EndsWithTheNameOfItsPage) {
  const Outcome outcome = summarize();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, testing::EndsWith("\nrun folder: " + run_.string() +
                                                "\nthe run as a page: " + page_.string() + "\n"));
  EXPECT_THAT(text_of(page_), HasSubstr("\"scenario\":\"paper_red_alone\""));
}

TEST_F(SummaryOfARun, WithoutAPageLeavesNoOldOne) {
  ASSERT_EQ(summarize().exit_code, 0);
  const Outcome outcome = summarize("--page false");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(page_));
  EXPECT_THAT(outcome.output, testing::EndsWith("\nrun folder: " + run_.string() + "\n"));
}

TEST_F(SummaryOfARun, WhosePageCannotBeWrittenEndsWithCodeTwo) {
  std::filesystem::create_directory(page_);
  const Outcome refused = summarize();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("summarize: no run.html: "));
  EXPECT_TRUE(std::filesystem::exists(run_ / "summary.json")) << "the result is written";
}

TEST_F(SummaryOfARun, RefusesChoicesOfAnotherRun) {
  const Outcome refused = summarize("--subgraph B");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, testing::StartsWith("summarize: --subgraph = B, must be D: "));
  EXPECT_EQ(std::ranges::count(refused.output, '\n'), 1) << refused.output;
}

TEST_F(SummaryOfARun, NamesRecordsThatAreCutOff) {
  cut("reports.csv");
  cut("vehicle_1.csv");
  const Outcome outcome = summarize();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(": reports.csv ends early: "));
  EXPECT_THAT(outcome.output, HasSubstr(": vehicle_1.csv ends early, at "));
  EXPECT_THAT(text_of(page_), HasSubstr("vehicle_1.csv ends early, at "));
}

TEST_F(Evaluate, KeepsRunFoldersAlsoOfRunsThatAreThereAlready) {
  ASSERT_EQ(evaluate("").exit_code, 0);
  const nlohmann::json without = timeless(results());
  const Outcome with = evaluate("--keep_runs");
  EXPECT_EQ(with.exit_code, 0) << with.output;
  for (const char* run : {"0", "1", "2", "3"}) {
    EXPECT_TRUE(std::filesystem::exists(out_ / "runs" / run / "run.json")) << run;
  }
  EXPECT_EQ(timeless(results()), without);
  std::filesystem::remove_all(out_ / "runs" / "2");
  const Outcome again = evaluate("--keep_runs");
  EXPECT_THAT(again.output, HasSubstr("3 of 4 runs already driven"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "runs" / "2" / "run.json"));
}

TEST_F(Evaluate, ARunFolderThatCannotBeWrittenIsNoFailureOfTheRun) {
  const Outcome done = run_program("evaluate --scenario paper_red_alone --steps 20" + kScenarios +
                                   " --out " + out_.string());
  ASSERT_EQ(done.exit_code, 0) << done.output;
  const nlohmann::json before = results();
  put(out_ / "runs", "a file where the run folders go");
  const Outcome failed = run_program("evaluate --keep_runs --scenario paper_red_alone --steps 20" +
                                     kScenarios + " --out " + out_.string());
  EXPECT_EQ(failed.exit_code, 2) << failed.output;
  EXPECT_THAT(failed.output, HasSubstr("runs/0: cannot be created"));
  EXPECT_EQ(results(), before);
}

TEST_F(Evaluate, ExportRefusesWhatIsNoRunFolder) {
  ASSERT_EQ(evaluate("--keep_runs").exit_code, 0);
  const std::filesystem::path run = out_ / "runs" / "0";
  const std::filesystem::path out = folder_ / "run.xml";
  const auto refused = [&](const std::filesystem::path& folder, const std::string& message) {
    const Outcome outcome =
        run_program("export_commonroad --run " + folder.string() + " --out " + out.string());
    EXPECT_EQ(outcome.exit_code, 2) << message;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(out)) << message;
  };
  const Outcome of_d = run_program("export_commonroad --subgraph D --run " + run.string() +
                                   " --out " + out.string());
  EXPECT_EQ(of_d.exit_code, 2);
  EXPECT_THAT(of_d.output, HasSubstr("--subgraph requires --scenario"));
  refused(folder_ / "nowhere", "nowhere/run.json: cannot be read");
  refused(out_, "run.json: cannot be read");
  const std::string reports = text_of(run / "reports.csv");
  put(run / "reports.csv", "step,id\n");
  refused(run, "reports.csv:1: the heading must be");
  put(run / "reports.csv", reports);
  std::filesystem::remove(run / "vehicle_1.csv");
  refused(run, "vehicle 1: no record of what it drove");
  std::filesystem::remove_all(run / "configuration");
  refused(run, "flags.yaml: missing");
}

TEST_F(Evaluate, WhatIsPrintedOnAFullDeviceIsAnOutputThatCannotBeWritten) {
  const std::string errors = (folder_ / "errors").string();
  const Outcome lost =
      evaluate(">/dev/full 2>" + errors + "; code=$?; cat " + errors + "; exit $code");
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.output,
              HasSubstr("evaluate: standard output: cannot be written: No space left"));
  EXPECT_EQ(results()["runs"].size(), 4U) << "what is written stays";
}

TEST(Help, OnAFullDeviceIsAnOutputThatCannotBeWritten) {
  EXPECT_EQ(run_program("evaluate --help >/dev/full 2>&1").exit_code, 2);
  EXPECT_EQ(run_program("export_commonroad --help >/dev/full 2>&1").exit_code, 2);
}

}  // namespace
}  // namespace hlc::test
