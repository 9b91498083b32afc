#include "planner/scenario/joint_problem_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "planner/scenario/problem_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::joint_problem_file_test {
namespace {

using testing::HasSubstr;

const std::string kProblems = test::source_folder() + "/launch_scripts/problems/";
const std::string kCrossing = kProblems + "two_at_a_crossing.json";

class JointProblemFileTest : public testing::Test {
 protected:
  /// The error of reading the shipped file with one piece replaced.
  [[nodiscard]] std::string error_with(const std::string& from, const std::string& to) const {
    std::string text((std::istreambuf_iterator<char>(std::ifstream(kCrossing).rdbuf())), {});
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::ofstream(file_) << text.replace(at, from.size(), to);
    try {
      static_cast<void>(read_joint_problem_file(
          file_, test::source_folder() + "/launch_scripts/automata/paper.yaml"));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "joint.json";
};

TEST_F(JointProblemFileTest, WhatIsWrittenReadsBackToTheSameText) {
  const JointProblemFile shipped = read_joint_problem_file(kCrossing);
  for (std::uint64_t seed = 0; seed < test::num_seeds(50); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    JointProblemFile file = shipped;
    file.problems.clear();
    for (std::size_t i = 0; i <= seed % kMostJointVehicles; ++i) {
      file.problems.push_back(test::random_problem(*file.subgraph, 1 + seed % 9, random));
    }
    file.search.max_expansions = 1 + seed;
    write_joint_problem_file(file, file_);
    ASSERT_TRUE(is_joint_problem_file(file_));
    const JointProblemFile again = read_joint_problem_file(file_, shipped.automaton_file);
    ASSERT_EQ(again.problems.size(), file.problems.size());
    EXPECT_EQ(to_text(again), to_text(file));
  }
}

TEST_F(JointProblemFileTest, EveryVehicleIsThatOfASingleProblem) {
  const JointProblemFile shipped = read_joint_problem_file(kCrossing);
  ASSERT_EQ(shipped.problems.size(), 2U);
  EXPECT_EQ(shipped.problems[1].start, (Pose{0.0, -0.6, 1.5707963267948966}));
  EXPECT_EQ(shipped.problems[0].boundary_m.size(), 2U);
  EXPECT_FALSE(is_joint_problem_file(kProblems + "parked_car.json"));
  const ProblemFile single = read_problem_file(kProblems + "parked_car.json");
  write_joint_problem_file({.automaton_file = single.automaton_file,
                            .subgraph = single.subgraph,
                            .problems = {single.problem},
                            .search = single.search},
                           file_);
  const ProblemFile alone{.automaton_file = single.automaton_file,
                          .subgraph = single.subgraph,
                          .problem = read_joint_problem_file(file_).problems.front(),
                          .search = single.search};
  EXPECT_EQ(to_text(alone), to_text(single));
}

TEST_F(JointProblemFileTest, ErrorsNameThePlace) {
  EXPECT_EQ(error_with("\"trim\": 7", "\"trim\": 7"), "");
  EXPECT_THAT(error_with("\"trim\": 7", "\"trim\": 13"),
              HasSubstr("joint.json: vehicles[0].start.trim = 13, must be"));
  EXPECT_THAT(error_with("\"vehicles\"", "\"cars\""),
              HasSubstr("unknown key; known keys: automaton, subgraph, horizon_steps, step_s, "
                        "vehicles, search"));
  EXPECT_THAT(error_with("\"reference\"", "\"path\""), HasSubstr("joint.json: vehicles[0].path"));
  EXPECT_THAT(error_with("\"horizon_steps\": 8", "\"horizon_steps\": 7"),
              HasSubstr("one per step, 7 of them"));
  EXPECT_THAT(error_with("\"horizon_steps\": 8", "\"start\": {}, \"horizon_steps\": 8"),
              HasSubstr("joint.json: start"));
  std::ofstream(file_) << R"({"automaton": "a", "subgraph": "B", "horizon_steps": 8,
                              "step_s": 0.2, "vehicles": []})";
  EXPECT_THROW(static_cast<void>(read_joint_problem_file(
                   file_, test::source_folder() + "/launch_scripts/automata/paper.yaml")),
               std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::joint_problem_file_test
