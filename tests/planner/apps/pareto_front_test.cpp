// The program: what it writes, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;

const std::string kExample =
    HLC_SOURCE_DIR "/launch_scripts/automata/pareto_example.yaml --from 0 0 --to 2.3 0.62";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class ParetoFrontProgram : public testing::Test {
 protected:
  ParetoFrontProgram()
      : folder_(fs::path(testing::TempDir()) /
                ("pareto_front_" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ParetoFrontProgram() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

  fs::path folder_;
};

TEST_F(ParetoFrontProgram, WritesTheFrontAsATableAndAsAPlot) {
  const auto [code, output] =
      run_program("pareto_front " + kExample + " --intervals 20 --points 7 --out " +
                  path("front.csv") + " --plot " + path("front.svg"));
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

  const std::string plot = text_of(path("front.svg"));
  EXPECT_TRUE(plot.starts_with("<svg")) << plot.substr(0, 40);
  for (const char* text : {"Pareto front", "Positions", "Orientations", "Inputs: acceleration",
                           "Inputs: steering rate", "s_x [m]", "psi [rad]", "knee"}) {
    EXPECT_NE(plot.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "something else was left";
}

TEST_F(ParetoFrontProgram, TheSameInputGivesTheSameBytes) {
  const std::string command = "pareto_front " + kExample + " --intervals 10 --points 4 --out " +
                              path("front.csv") + " --plot " + path("front.svg");
  ASSERT_EQ(run_program(command).exit_code, 0);
  const std::string table = text_of(path("front.csv"));
  const std::string plot = text_of(path("front.svg"));
  ASSERT_EQ(run_program(command).exit_code, 0);
  EXPECT_EQ(text_of(path("front.csv")), table);
  EXPECT_EQ(text_of(path("front.svg")), plot);
}

TEST_F(ParetoFrontProgram, RefusesBadInputInOneLineWithCodeTwoAndLeavesTheFileThatWasThere) {
  std::ofstream(path("front.csv")) << "old";
  std::ofstream(path("broken.yaml")) << "limits: {acceleration_mps2: -1}\n";
  const std::string out = " --out " + path("front.csv");
  struct Bad {
    std::string flags;
    std::string named;
  };
  const std::string file = HLC_SOURCE_DIR "/launch_scripts/automata/pareto_example.yaml";
  for (const Bad& bad :
       {Bad{"", "configuration"}, Bad{file + " --from 0 0" + out, "--to"}, Bad{kExample, "--out"},
        Bad{kExample + out + " --colour red", "--colour"},
        Bad{kExample + out + " --points 1", "--points"},
        Bad{kExample + out + " --points many", "--points"},
        Bad{kExample + out + " --duration 0", "--duration"},
        Bad{kExample + out + " --criteria J1 J9", "J9"},
        Bad{kExample + out + " --criteria J1 J1", "--criteria = J1 J1"},
        Bad{kExample + out + " --duration 0.1", "needs acceleration 23 m/s^2, allowed 20 m/s^2"},
        Bad{file + " --from 0 0 --to 9 0" + out, "speed of a trim = 9 m/s, allowed 0 ... 3.7"},
        Bad{path("none.yaml") + " --from 0 0 --to 1 0" + out, "none.yaml"},
        Bad{path("broken.yaml") + " --from 0 0 --to 1 0" + out, "broken.yaml"}}) {
    const auto [code, output] = run_program("pareto_front " + bad.flags);
    EXPECT_EQ(code, 2) << bad.flags << ": " << output;
    EXPECT_NE(output.find(bad.named), std::string::npos) << bad.flags << ": " << output;
    EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
  }
  EXPECT_EQ(text_of(path("front.csv")), "old");
}

TEST_F(ParetoFrontProgram, TakesNegativeSteeringAndOtherCriteria) {
  const auto [code, output] = run_program(
      "pareto_front " HLC_SOURCE_DIR
      "/launch_scripts/automata/paper.yaml --from 0.8 -0.12 --to 0 0 --criteria comfort energy "
      "--points 3 --out " +
      path("front.csv"));
  ASSERT_EQ(code, 0) << output;
  EXPECT_TRUE(text_of(path("front.csv")).starts_with("comfort,energy,dx"));
}

}  // namespace
}  // namespace hlc::test
