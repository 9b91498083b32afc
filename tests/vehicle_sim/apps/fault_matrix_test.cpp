// The program with flags that it must refuse, and with a few cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps::fault_matrix_test {
namespace {

const std::string kCell = "\"controller, kill, run: real time, lab, two rounds\"";

test::Outcome run_matrix(const std::string& flags) {
  return test::run_program("fault_matrix --scenario_folder " + test::source_folder() +
                           "/launch_scripts/scenarios " + flags);
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t rows_of(const std::string& text) {
  std::size_t rows = 0;
  for (const char* role : {"controller", "vehicle", "middleware", "lab control"}) {
    const std::string begin = std::string("\n| ") + role + " | ";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1))
      ++rows;
  }
  return rows;
}

struct BadMatrixFlags {
  std::string flags;
  std::string named;  ///< what the message must speak of
};
void PrintTo(const BadMatrixFlags& one, std::ostream* out) { *out << '"' << one.flags << '"'; }

class FaultMatrixRefuses : public testing::TestWithParam<BadMatrixFlags> {};

TEST_P(FaultMatrixRefuses, InOneLineWithExitCodeTwo) {
  const auto [exit_code, output] = run_matrix(GetParam().flags);
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_NE(output.find(GetParam().named), std::string::npos) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
}

INSTANTIATE_TEST_SUITE_P(
    Flags, FaultMatrixRefuses,
    testing::Values(BadMatrixFlags{"--runs 0", "--runs"}, BadMatrixFlags{"--seed -1", "--seed"},
                    BadMatrixFlags{"--jobs 0", "--jobs"}, BadMatrixFlags{"--speed 3", "--speed"},
                    BadMatrixFlags{"--cells storm", "storm"},
                    BadMatrixFlags{"--cells forged", "forged"},
                    BadMatrixFlags{"--trace x.txt", "--trace"},
                    BadMatrixFlags{"--cells " + kCell + " --trace /no/such/folder/x", "--trace"}));

TEST(FaultMatrixProgram, HelpIsGoodAndNamesTheExitCodes) {
  const auto [exit_code, output] = run_matrix("--help");
  EXPECT_EQ(exit_code, 0);
  EXPECT_NE(output.find("Exit codes"), std::string::npos);
}

TEST(FaultMatrixProgram, WritesARowForEachRoleFaultAndPhase) {
  const test::TemporaryFolder folder;
  const std::string report = (folder / "report.md").string();
  const std::string trace = (folder / "trace.txt").string();
  const auto [exit_code, output] =
      run_matrix("--cells " + kCell + " --table " + report + " --trace " + trace);
  EXPECT_EQ(exit_code, 0) << output;
  EXPECT_NE(output.find("1 cells run: 1 passed"), std::string::npos) << output;
  EXPECT_EQ(rows_of(text_of(report)), 4U * 9U * 3U);
  EXPECT_NE(text_of(trace).find("begin of"), std::string::npos);
}

TEST(FaultMatrixProgram, ReplacesOnlyTheTableOfADocument) {
  const test::TemporaryFolder folder;
  const std::filesystem::path document = folder / "document.md";
  std::ofstream(document) << "before\n<!-- fault_matrix -->\nold\n<!-- end of fault_matrix -->\n"
                             "after\n";
  EXPECT_EQ(run_matrix("--cells " + kCell + " --table " + document.string()).exit_code, 0);
  const std::string text = text_of(document);
  EXPECT_TRUE(text.starts_with("before\n<!-- fault_matrix -->\n`fault_matrix ")) << text;
  EXPECT_TRUE(text.ends_with("<!-- end of fault_matrix -->\nafter\n")) << text;
  EXPECT_EQ(text.find("old"), std::string::npos);
  std::ofstream(document) << "a document without marks\n";
  EXPECT_EQ(run_matrix("--cells " + kCell + " --table " + document.string()).exit_code, 2);
  EXPECT_EQ(text_of(document), "a document without marks\n");
}

// The table is written by the program from a run of all cells.
TEST(FaultMatrixProgram, ItsTableInTheReadmeIsWhole) {
  const std::string text = text_of(test::source_folder() + "/tests/soak/README.md");
  EXPECT_EQ(rows_of(text), 4U * 9U * 3U);
  EXPECT_NE(text.find("480 cells run: "), std::string::npos);
}

}  // namespace
}  // namespace hlc::apps::fault_matrix_test
