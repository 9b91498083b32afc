// build_automaton and show_automaton as they are called, and a scenario that drives with their
// file.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "planner/maneuver_design/automaton_builder.hpp"
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

class AutomatonPrograms : public testing::Test {
 protected:
  AutomatonPrograms() { write("car.yaml", configuration_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] Outcome build(const std::string& more = "") const {
    return run_program("build_automaton " + path("car.yaml") + " --out " + path("automaton.yaml") +
                       " " + more);
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      result.push_back(entry.path().filename().string());
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Quick: J2 and J3 have constant inputs.
  const std::string configuration_ =
      R"(vehicle: {wheelbase_m: 0.15, rear_axle_to_cg_m: 0.075, length_m: 0.22, width_m: 0.107}
limits: {acceleration_mps2: 12, steering_rate_radps: 6.2, speed_min_mps: 0, speed_max_mps: 3.7, steering_max_rad: 0.62}
trims:
  - {speed_mps: 0, steering_rad: 0}
  - {speed_mps: 0.8, steering_rad: 0}
  - {speed_mps: 0.6, steering_rad: 0.36}
  - {speed_mps: 0.6, steering_rad: -0.36}
step_s: 0.2
criteria: [J2, J3]
subgraphs:
  - {name: B, label: J2, trims: [1, 3, 2, 4]}
  - {name: C, label: J3, trims: [1, 3, 4]}
)";
  const test::TemporaryFolder folder_;
};

TEST_F(AutomatonPrograms, WritesFileAndTableTheSameForAnyNumberOfJobs) {
  const Outcome one = build("--jobs 1 --table " + path("one.csv"));
  EXPECT_EQ(one.exit_code, 0) << one.output;
  EXPECT_EQ(std::ranges::count(one.output, '\n'), 1) << one.output;
  const std::string file = text_of("automaton.yaml");
  EXPECT_EQ(build("--jobs 3 --table " + path("three.csv")).exit_code, 0);
  EXPECT_EQ(text_of("automaton.yaml"), file);
  EXPECT_EQ(text_of("one.csv"), text_of("three.csv"));
  EXPECT_EQ(names(),
            (std::vector<std::string>{"automaton.yaml", "car.yaml", "one.csv", "three.csv"}));
}

TEST_F(AutomatonPrograms, TheTableHasOneRowPerEdgeAndLabelInFullPrecision) {
  ASSERT_EQ(build("--intervals 25 --table " + path("maneuvers.csv")).exit_code, 0);
  std::istringstream table(text_of("maneuvers.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "from,to,criterion,intervals,J1,J2,dx,dy,dpsi,v_max,status");
  maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(folder_ / "car.yaml");
  configuration.intervals = 25;
  const automaton::UniversalAutomaton automaton = maneuver_design::build_automaton(configuration);
  std::size_t rows = 0;
  while (std::getline(table, line)) {
    ++rows;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 11U) << line;
    const automaton::Maneuver* m =
        automaton.find({std::stoul(cells[0]) - 1}, {std::stoul(cells[1]) - 1}, cells[2]);
    ASSERT_NE(m, nullptr) << line;
    EXPECT_NE(m->from, m->to);
    EXPECT_EQ(cells[3], "25");
    EXPECT_EQ(std::stod(cells[4]), m->criteria[0].value);
    EXPECT_EQ(std::stod(cells[5]), m->criteria[1].value);
    EXPECT_EQ(std::stod(cells[6]), m->displacement.x_m);
    EXPECT_EQ(std::stod(cells[7]), m->displacement.y_m);
    EXPECT_EQ(std::stod(cells[8]), m->displacement.heading_rad);
    EXPECT_EQ(std::stod(cells[9]), automaton::top_speed_mps(*m));
    EXPECT_EQ(cells[10], "optimal");
  }
  EXPECT_EQ(rows, 2 * (6 + 4 + 2U));  // chain 1 3 2 4: 6 and 4; C adds 3-4 both ways
}

TEST_F(AutomatonPrograms, TheDrawingHasEveryTrimAndManeuver) {
  const DeployedProgram program("build_automaton");
  const std::string flags = path("car.yaml") + " --out " + path("automaton.yaml");
  const Outcome done = program.run(flags);
  ASSERT_EQ(done.exit_code, 0) << done.output;
  EXPECT_EQ(program.kind(), "automaton");
  const nlohmann::json drawn = program.drawn();
  EXPECT_EQ(drawn["labels"], (nlohmann::json{"J2", "J3"}));
  EXPECT_EQ(drawn["trims"].size(), 4U);
  EXPECT_EQ(drawn["maneuvers"].size(), 2 * 12U);  // six pairs in both directions
  for (const nlohmann::json& maneuver : drawn["maneuvers"]) {
    EXPECT_NE(maneuver["from"], maneuver["to"]);
    EXPECT_LE(maneuver["to"], 4);
  }
}

TEST_F(AutomatonPrograms, WhatIsNotDrawnIsOneLineWithExitCode3AndTheAutomatonIsWritten) {
  const DeployedProgram program("build_automaton");
  const std::string flags = path("car.yaml") + " --out " + path("automaton.yaml");
  program.put_script("echo no packages >&2; exit 3");
  const Outcome without = program.run(flags);
  EXPECT_EQ(without.exit_code, 3);
  EXPECT_NE(without.output.find("no packages\n"), std::string::npos) << without.output;
  EXPECT_EQ(std::ranges::count(without.output, '\n'), 2) << without.output;  // and the counts
  EXPECT_FALSE(std::filesystem::exists(program.plot()));
  program.remove_script();
  const Outcome missing = program.run(flags);
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.output.find("report/draw.sh is missing, must be beside"), std::string::npos);
  EXPECT_EQ(std::ranges::count(missing.output, '\n'), 2) << missing.output;
  EXPECT_FALSE(text_of("automaton.yaml").empty());
}

TEST_F(AutomatonPrograms, BadInputIsOneLineWithExitCode2AndLeavesTheOldFileAlone) {
  ASSERT_EQ(build().exit_code, 0);
  const std::string before = text_of("automaton.yaml");
  const auto expect_refused = [&](const Outcome& outcome, const std::string& named) {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_NE(outcome.output.find(named), std::string::npos) << outcome.output;
    EXPECT_EQ(text_of("automaton.yaml"), before);
  };
  expect_refused(build("--shape round"), "--shape");
  expect_refused(build("--intervals 5"), "--intervals");
  expect_refused(build("--jobs 0"), "--jobs");
  expect_refused(build("--table " + path("no/table.csv")), "--table");
  expect_refused(run_program("build_automaton " + path("car.yaml")), "--out");
  expect_refused(run_program("build_automaton " + path("absent.yaml") + " --out " + path("x.yaml")),
                 "cannot be read");
  expect_refused(
      run_program("build_automaton " + path("automaton.yaml") + " --out " + path("x.yaml")),
      "must be a configuration");
  expect_refused(run_program("build_automaton " + path("car.yaml") + " --out " + path("car.yaml")),
                 "other than the input");
  expect_refused(build("--table " + path("automaton.yaml")), "--table = ");
  expect_refused(build("--table " + path("x.csv") + " --plot " + path("./x.csv")), "--plot = ");
  expect_refused(build("--table \"\""), "--table = , must be");
  // A pipe stands for every device: one of the machine would be at stake.
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  expect_refused(build("--plot " + path("pipe")), "must be a new or a regular file");
  fs::remove(path("pipe"));
  expect_refused(run_program("build_automaton /dev/zero --out " + path("x.yaml")),
                 "/dev/zero: cannot be read");

  std::string weak = configuration_;
  weak.replace(weak.find("acceleration_mps2: 12"), 21, "acceleration_mps2: 2");
  write("car.yaml", weak);
  expect_refused(build(), "car.yaml:11: subgraphs[1].trims = (a list), must be");
  expect_refused(build(), "needs acceleration");
  std::string typing_error = configuration_;
  typing_error.replace(typing_error.find("criteria:"), 9, "criterias:");
  write("car.yaml", typing_error);
  expect_refused(build(), "car.yaml:1: criteria is missing");
  EXPECT_EQ(names(), (std::vector<std::string>{"automaton.yaml", "car.yaml"}));
}

TEST_F(AutomatonPrograms, WhatOnlyTheManeuversShowIsRefusedWithTheKeyThatIsToBlame) {
  const auto refusal = [this](const std::string& piece, const std::string& replacement,
                              const std::string& flags = "") {
    std::string text = configuration_;
    text.replace(text.find(piece), piece.size(), replacement);
    write("car.yaml", text);
    const Outcome outcome = build(flags);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    return outcome.output;
  };
  const std::string begin = "build_automaton: " + path("car.yaml");
  // J1 is faster on its way than at its ends: the limit leaves the trims, but takes their edges.
  EXPECT_EQ(refusal("criteria: [J2, J3]\nsubgraphs:\n",
                    "criteria: [J2, J3, J1]\nsubgraphs:\n"
                    "  - {name: A, label: J1, trims: [1, 3, 4], max_speed_mps: 0.61}\n"),
            begin +
                ":11: subgraphs[1].max_speed_mps = 0.61, must be a limit that leaves every trim a "
                "way from and to standstill; subgraph 'A': no way from trim 3 to a trim of speed "
                "0\n");
  const std::string coarse = "intervals = 20, must be more; maneuver 1 -> 3 (J2): integrated again";
  EXPECT_TRUE(
      refusal("step_s: 0.2", "step_s: 10", "--jobs 1").starts_with(begin + ":1: " + coarse));
  EXPECT_TRUE(refusal("step_s: 0.2", "step_s: 10\nintervals: 20", "--jobs 1")
                  .starts_with(begin + ":9: " + coarse));
  EXPECT_TRUE(refusal("step_s: 0.2", "step_s: 10\nintervals: 90", "--jobs 1 --intervals 20")
                  .starts_with("build_automaton: --" + coarse));
}

TEST_F(AutomatonPrograms, ShowPrintsTrimsLabelsAndSubgraphs) {
  ASSERT_EQ(build().exit_code, 0);
  const Outcome shown = run_program("show_automaton " + path("automaton.yaml"));
  EXPECT_EQ(shown.exit_code, 0) << shown.output;
  for (const char* part :
       {"built from car.yaml", "   2       0.8              0    3     3", "comfort",
        "J2               12", "B            J2           chain           4     10      0  0 1 1 1",
        "C            J3           chain           3      6      1  0 1 1 1"}) {
    EXPECT_NE(shown.output.find(part), std::string::npos) << part << "\n" << shown.output;
  }
}

TEST_F(AutomatonPrograms, ShowRefusesWhatIsStaleEditedOrNoAutomaton) {
  ASSERT_EQ(build().exit_code, 0);
  const auto expect_refused = [&](const std::string& flags, const std::string& named) {
    const Outcome outcome = run_program("show_automaton " + flags);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_NE(outcome.output.find(named), std::string::npos) << outcome.output;
  };
  expect_refused(path("car.yaml"), "no built automaton");
  expect_refused("/dev/zero", "/dev/zero: cannot be read");
  expect_refused("", "AUTOMATON");
  std::string other = configuration_;
  other.replace(other.find("width_m: 0.107"), 14, "width_m: 0.100");
  write("other.yaml", other);
  expect_refused(path("automaton.yaml") + " --configuration " + path("other.yaml"), "stale");
  write("car.yaml", other);
  expect_refused(path("automaton.yaml"), "rebuild it: build_automaton " + path("car.yaml"));
  write("car.yaml", configuration_);
  std::string edited = text_of("automaton.yaml");
  edited.replace(edited.find("width_m: 0.107"), 14, "width_m: 0.100");
  write("automaton.yaml", edited);
  expect_refused(path("automaton.yaml"), "it was edited or damaged");
}

TEST_F(AutomatonPrograms, AScenarioDrivesWithABuiltFileAsWithItsConfiguration) {
  ASSERT_EQ(build().exit_code, 0);
  const auto scenario = [&](const std::string& automaton) {
    return "name: circle\nsteps: 60\nautomaton: " + automaton +
           "\nsubgraph: B\ncircle: {cars: 3, radius_m: 1.2, centre_x_m: 2, centre_y_m: 2}\n";
  };
  write("from_file.yaml", scenario("automaton.yaml"));
  write("from_configuration.yaml", scenario("car.yaml"));
  const auto drive = [&](const std::string& name) {
    const Outcome outcome = run_program("rollout --scenario " + path(name));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output.substr(0, outcome.output.rfind("60 steps in"));
  };
  EXPECT_EQ(drive("from_file.yaml"), drive("from_configuration.yaml"));

  std::string other = configuration_;
  other.replace(other.find("width_m: 0.107"), 14, "width_m: 0.100");
  write("car.yaml", other);
  const Outcome stale = run_program("rollout --scenario " + path("from_file.yaml"));
  EXPECT_EQ(stale.exit_code, 2);
  EXPECT_NE(stale.output.find("stale"), std::string::npos) << stale.output;
}

TEST(Rollout, LosesTheStatedShareOfMessagesForTheStatedTime) {
  const auto drive = [](const std::string& flags) {
    const Outcome outcome = run_program("rollout --steps 40 --scenario " + test::source_folder() +
                                        "/launch_scripts/scenarios/paper_three_cars.yaml " + flags);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output.substr(0, outcome.output.rfind("40 steps in"));
  };
  const std::string lossless = drive("");
  EXPECT_NE(lossless.find("new plans in 100.0 % of the steps"), std::string::npos) << lossless;
  EXPECT_EQ(drive("--lost 0.3 --lost_steps 0"), lossless);
  EXPECT_NE(drive("--lost 0.3"), lossless);
  EXPECT_NE(drive("--lost 0.3"), drive("--lost 0.3 --loss_seed 2"));
  EXPECT_EQ(drive("--lost 0.3"), drive("--lost 0.3 --loss_seed 1"));
  const auto new_plans = [&](const std::string& flags) {
    const std::string begin = "new plans in ";
    const std::string text = drive(flags);
    return std::stod(text.substr(text.find(begin) + begin.size()));
  };
  EXPECT_LT(new_plans("--lost 0.1"), 100.0);
  EXPECT_LT(new_plans("--lost 1"), new_plans("--lost 0.1"));
}

TEST(GenerateMap, WritesAMapAndRefusesWhatIsNoFile) {
  const test::TemporaryFolder folder;
  const fs::path map = folder / "map.xml";
  EXPECT_EQ(run_program("generate_map --out " + map.string()).exit_code, 0);
  EXPECT_GT(fs::file_size(map), 1000U);
  const Outcome outcome = run_program("generate_map --out " + folder.path().string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(outcome.output.starts_with("generate_map: --out = ")) << outcome.output;
  EXPECT_EQ(run_program("generate_map --shape lab_network --out " + map.string()).exit_code, 0);
  const Outcome unknown = run_program("generate_map --shape lab --out " + map.string());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.output.find("lab_network"), std::string::npos) << unknown.output;
}

TEST(GenerateMap, WritesTownsAndRefusesSizesOutOfBounds) {
  const test::TemporaryFolder folder;
  const std::string generate = "generate_map --out " + (folder / "town.xml").string();
  EXPECT_EQ(run_program(generate + " --blocks 2x1").output, "136 lanelets\n");
  for (const char* blocks : {"2", "2x", "x2", "0x1", "1x13", "2x1x1", "-1x1", "axb"}) {
    const Outcome outcome = run_program(generate + " --blocks " + blocks);
    EXPECT_EQ(outcome.exit_code, 2) << blocks;
    EXPECT_NE(outcome.output.find("must be WxH, each in 1 ... 12"), std::string::npos)
        << outcome.output;
  }
  EXPECT_EQ(run_program(generate + " --blocks 2x1 --shape lab_like").exit_code, 2);
}

}  // namespace
}  // namespace hlc::apps
