// The program: what it writes, and what it refuses.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <vector>

#include "tests/planner/apps/deployed_program.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

const std::string kExample =
    test::source_folder() + "/launch_scripts/automata/pareto_example.yaml --from 0 0 --to 2.3 0.62";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class ParetoFrontProgram : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

  const TemporaryFolder folder_;
};

TEST_F(ParetoFrontProgram, WritesTheFrontAsATableAndDrawsIt) {
  const DeployedProgram program("pareto_front");
  const auto [code, output] =
      program.run(kExample + " --intervals 20 --points 7 --out " + path("front.csv"));
  ASSERT_EQ(code, 0) << output;
  EXPECT_NE(output.find("knee"), std::string::npos);
  EXPECT_NE(output.find("hypervolume"), std::string::npos);

  std::istringstream table(text_of(path("front.csv")));
  std::string line;
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("J1,J2,dx,dy,dpsi,status,")) << line;
  std::vector<double> j1;
  int knees = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 10U) << line;
    j1.push_back(std::stod(cells[0]));
    EXPECT_EQ(cells[5], "optimal");
    EXPECT_EQ(cells[7], "0");
    knees += std::stoi(cells[8]);
  }
  EXPECT_EQ(j1.size(), 7U);
  EXPECT_TRUE(std::ranges::is_sorted(j1, std::greater{}));
  EXPECT_EQ(knees, 1);

  EXPECT_EQ(program.kind(), "pareto");
  const nlohmann::json drawn = program.drawn();
  EXPECT_EQ(drawn["criteria"], (nlohmann::json{"J1", "J2"}));
  EXPECT_EQ(drawn["to"], (nlohmann::json{2.3, 0.62}));
  EXPECT_EQ(drawn["duration_s"][0], drawn["duration_s"][1]);
  ASSERT_EQ(drawn["points"].size(), j1.size());
  for (std::size_t i = 0; i < j1.size(); ++i) {
    const nlohmann::json& point = drawn["points"][i];
    EXPECT_EQ(point["objectives"][0], j1[i]);
    EXPECT_EQ(point["is_converged"], true);
    EXPECT_EQ(point["inputs"].size(), 20U);
    EXPECT_EQ(point["states"].size(), 21U);
  }
  EXPECT_GT(drawn["weighted_sums"].size(), 2U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1)
      << "something else was left";
}

TEST_F(ParetoFrontProgram, TheSameInputGivesTheSameBytes) {
  const DeployedProgram program("pareto_front");
  const std::string flags = kExample + " --intervals 10 --points 4 --out " + path("front.csv");
  ASSERT_EQ(program.run(flags).exit_code, 0);
  const std::string table = text_of(path("front.csv"));
  const std::string plot = text_of(program.plot());
  ASSERT_EQ(program.run(flags).exit_code, 0);
  EXPECT_EQ(text_of(path("front.csv")), table);
  EXPECT_EQ(text_of(program.plot()), plot);
}

TEST_F(ParetoFrontProgram, RefusesBadInputInOneLineWithCodeTwoAndLeavesTheFileThatWasThere) {
  std::ofstream(path("front.csv")) << "old";
  fs::copy_file(test::source_folder() + "/launch_scripts/automata/pareto_example.yaml",
                path("copy.yaml"));
  // A pipe stands for every device: one of the machine would be at stake.
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::ofstream(path("broken.yaml")) << "limits: {acceleration_mps2: -1}\n";
  const std::string out = " --out " + path("front.csv");
  struct Bad {
    std::string flags;
    std::string named;
  };
  const std::string file = test::source_folder() + "/launch_scripts/automata/pareto_example.yaml";
  for (const Bad& bad :
       {Bad{"", "CONFIGURATION"},
        Bad{file + " --from 0 0" + out, "--to"},
        Bad{kExample, "--out"},
        Bad{kExample + out + " --colour red", "--colour"},
        Bad{kExample + out + " --points 1", "--points"},
        Bad{kExample + out + " --points many", "--points"},
        Bad{kExample + out + " --duration_s 0", "--duration_s"},
        Bad{kExample + out + " --criteria J1 J9", "J9"},
        Bad{kExample + out + " --criteria J1 J1", "--criteria = J1 J1"},
        Bad{kExample + out + " --duration_s 0.1",
            "needs acceleration 23 m/s^2, must be <= 20 m/s^2"},
        Bad{file + " --from 0 0 --to 9 0" + out,
            "--to = 9 0, must be in 0 ... 3.7 m/s and -0.62 ... 0.62 rad"},
        Bad{file + " --from 0 0.7 --to 1 0" + out, "--from = 0 0.7, must be in"},
        Bad{file + " --from 0 nan --to 1 0" + out, "--from: nan, must be a finite number"},
        Bad{file + " --from 0 0 --to nan 0.62" + out, "--to: nan, must be a finite number"},
        Bad{file + " --from 0 0 --to 1 inf" + out, "--to: inf, must be a finite number"},
        Bad{kExample + out + " --duration_s nan", "--duration_s: nan, must be in 0.001 ... 100"},
        Bad{kExample + out + " --free_duration_s 0.2 nan", "--free_duration_s: nan, must be in"},
        Bad{kExample + out + " --free_duration_s 0.3 0.2",
            "--free_duration_s = 0.3 0.2, must be MIN"},
        Bad{kExample + out + " --free_duration_s 0.1 0.2 --duration_s 0.2", "--free_duration_s"},
        Bad{kExample + out + " --plot " + path("front.csv"), "--plot = "},
        Bad{kExample + out + " --plot \"\"", "--plot = , must be"},
        Bad{kExample + " --out " + path("pipe"), "must be a new or a regular file"},
        Bad{kExample + " --out " + path("no/front.csv"), "--out = "},
        Bad{path("copy.yaml") + " --from 0 0 --to 2.3 0.62 --out " + path("copy.yaml"),
            "must be a file other than the input"},
        Bad{path("none.yaml") + " --from 0 0 --to 1 0" + out, "none.yaml"},
        Bad{path("broken.yaml") + " --from 0 0 --to 1 0" + out, "broken.yaml"}}) {
    const auto [code, output] = run_program("pareto_front " + bad.flags);
    EXPECT_EQ(code, 2) << bad.flags << ": " << output;
    EXPECT_NE(output.find(bad.named), std::string::npos) << bad.flags << ": " << output;
    EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
  }
  EXPECT_EQ(text_of(path("front.csv")), "old");
  EXPECT_EQ(text_of(path("copy.yaml")), text_of(file));
}

TEST_F(ParetoFrontProgram, AFreeDurationIsChosenWithinItsBoundsAndTold) {
  const DeployedProgram program("pareto_front");
  const auto [code, output] =
      program.run(kExample +
                  " --intervals 10 --points 4 --criteria travel_time J2 --free_duration_s 0.15 0.4 "
                  "--out " +
                  path("front.csv"));
  ASSERT_EQ(code, 0) << output;
  std::istringstream table(text_of(path("front.csv")));
  std::string line;
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("travel_time,J2,dx,dy,dpsi,status,duration,v_max,")) << line;
  std::vector<double> durations_s;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 11U) << line;
    EXPECT_EQ(cells[5], "optimal");
    durations_s.push_back(std::stod(cells[6]));
    EXPECT_NEAR(durations_s.back(), std::stod(cells[0]), 1e-9);
  }
  ASSERT_EQ(durations_s.size(), 4U);
  EXPECT_NEAR(durations_s.front(), 0.4, 1e-9);  // soft inputs take all the time that there is
  EXPECT_NEAR(durations_s.back(), 0.15, 1e-9);
  EXPECT_TRUE(std::ranges::is_sorted(durations_s, std::greater{}));
  EXPECT_EQ(program.drawn()["duration_s"], (nlohmann::json{0.15, 0.4}));
}

TEST_F(ParetoFrontProgram, TakesNegativeSteeringAndOtherCriteria) {
  const auto [code, output] = run_program(
      "pareto_front " + test::source_folder() +
      "/launch_scripts/automata/paper.yaml --from 0.8 -0.12 --to 0 0 --criteria comfort energy "
      "--points 3 --out " +
      path("front.csv"));
  ASSERT_EQ(code, 0) << output;
  EXPECT_TRUE(text_of(path("front.csv")).starts_with("comfort,energy,dx"));
}

}  // namespace
}  // namespace hlc::test
