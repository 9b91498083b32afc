#include "planner/road/planning_problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "planner/geometry/footprint.hpp"

namespace hlc::road::planning_problem_test {
namespace {

using testing::HasSubstr;

std::string file_with(const std::string& content, const std::string& version = "2020a",
                      const std::string& step = "0.1") {
  return "<commonRoad benchmarkID=\"ZAM_A-1\" commonRoadVersion=\"" + version +
         "\" timeStepSize=\"" + step + "\">\n" + content + "\n</commonRoad>\n";
}

std::string exact(const std::string& name, const std::string& value) {
  return "<" + name + "><exact>" + value + "</exact></" + name + ">";
}

std::string interval(const std::string& name, const std::string& from, const std::string& to) {
  return "<" + name + "><intervalStart>" + from + "</intervalStart><intervalEnd>" + to +
         "</intervalEnd></" + name + ">";
}

const std::string kPosition = "<position><point><x>3</x><y>4</y></point></position>";
const std::string kInitial = kPosition + exact("orientation", "0.5") + exact("time", "0") +
                             exact("velocity", "7") + exact("yawRate", "0.1") +
                             exact("slipAngle", "0.2");
const std::string kBox =
    "<rectangle><length>8</length><width>2</width><orientation>0.3</orientation>"
    "<center><x>50</x><y>1</y></center></rectangle>";
const std::string kTime = interval("time", "20", "300");

std::string goal(const std::string& regions, const std::string& more = kTime) {
  return "<goalState><position>" + regions + "</position>" + more + "</goalState>";
}

std::string problem(const std::string& initial, const std::string& goals,
                    const std::string& id = "100") {
  return "<planningProblem id=\"" + id + "\"><initialState>" + initial + "</initialState>" + goals +
         "</planningProblem>";
}

std::vector<PlanningProblem> read(const std::string& xml) {
  return parse_planning_problems(xml, "file.xml");
}

std::string refusal(const std::string& content) {
  try {
    static_cast<void>(read(file_with(content)));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(PlanningProblems, HaveTheirInitialStateAndGoalsInSeconds) {
  const auto problems =
      read(file_with(problem(kInitial, goal(kBox, kTime + interval("velocity", "0", "5") +
                                                      interval("orientation", "-0.2", "0.4")) +
                                           goal("<lanelet ref=\"3\"/><lanelet ref=\"4\"/>"))));
  ASSERT_EQ(problems.size(), 1U);
  const PlanningProblem& read_problem = problems[0];
  EXPECT_EQ(read_problem.id, 100);
  EXPECT_EQ(read_problem.start, (Pose{3.0, 4.0, 0.5}));
  EXPECT_EQ(read_problem.speed_mps, 7.0);
  EXPECT_EQ(read_problem.yaw_rate_radps, 0.1);
  EXPECT_EQ(read_problem.slip_angle_rad, 0.2);
  EXPECT_EQ(read_problem.acceleration_mps2, 0.0);
  ASSERT_EQ(read_problem.goals.size(), 2U);
  EXPECT_EQ(read_problem.goals[0].areas_m,
            std::vector{footprint_area({8.0, 2.0}, {50.0, 1.0, 0.3})});
  EXPECT_NEAR(read_problem.goals[0].time_s.from, 2.0, 1e-12);
  EXPECT_NEAR(read_problem.goals[0].time_s.to, 30.0, 1e-12);
  EXPECT_EQ(read_problem.goals[0].speed_mps, (Interval{0.0, 5.0}));
  EXPECT_EQ(read_problem.goals[0].heading_rad, (Interval{-0.2, 0.4}));
  EXPECT_EQ(read_problem.goals[1].lanelets, (std::vector<LaneletId>{3, 4}));
  EXPECT_FALSE(read_problem.goals[1].speed_mps);
}

TEST(PlanningProblems, AreReadFromBothVersionsInTheOrderOfTheFile) {
  const std::string both = problem(kInitial, goal(kBox), "9") + problem(kInitial, goal(kBox), "2");
  const auto problems = read(file_with(both));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].id, 9);
  EXPECT_EQ(problems[1].id, 2);
  EXPECT_EQ(read(file_with(both, "2018b")), problems);
}

TEST(PlanningProblems, HaveExactTimesToo) {
  const auto problems = read(file_with(problem(kInitial, goal(kBox, exact("time", "70")))));
  EXPECT_NEAR(problems[0].goals[0].time_s.from, 7.0, 1e-12);
  EXPECT_NEAR(problems[0].goals[0].time_s.to, 7.0, 1e-12);
}

TEST(PlanningProblems, HaveGoalsWithinTheCirclesOfTheFile) {
  const auto problems = read(file_with(problem(
      kInitial, goal("<circle><radius>4</radius><center><x>9</x><y>2</y></center></circle>"))));
  for (const Point& corner : problems[0].goals[0].areas_m[0].vertices_m) {
    EXPECT_NEAR((corner - Point(9.0, 2.0)).norm(), 4.0, 1e-9);
  }
}

TEST(PlanningProblems, WhatIsNotRegardedIsRefusedByItsName) {
  EXPECT_THAT(refusal(problem(kInitial + exact("jerk", "0"), goal(kBox))),
              HasSubstr("file.xml:2: <jerk> in <initialState> is not regarded, must be absent"));
  EXPECT_THAT(refusal(problem(kInitial, goal(kBox, kTime + exact("yawRate", "0")))),
              HasSubstr("<yawRate> in <goalState> is not regarded"));
  EXPECT_THAT(refusal(problem(kInitial, goal(kBox) + "<hope/>")),
              HasSubstr("<hope> in <planningProblem> is not regarded"));
  EXPECT_THAT(refusal(problem(kInitial, goal("<point><x>1</x><y>1</y></point>"))),
              HasSubstr("<position> has a <point>, must be a <rectangle>, <circle> or <polygon>"));
  EXPECT_THAT(refusal(problem(kInitial, goal(kBox, kTime + kTime))),
              HasSubstr("<time> twice in <goalState>, must be once"));
}

TEST(PlanningProblems, WithUncertainInitialStatesAreRefused) {
  const std::string rest = exact("orientation", "0.5") + exact("time", "0");
  EXPECT_THAT(refusal(problem("<position>" + kBox + "</position>" + rest + exact("velocity", "0"),
                              goal(kBox))),
              HasSubstr("<position> needs a <point>"));
  EXPECT_THAT(refusal(problem(kPosition + rest + interval("velocity", "0", "1"), goal(kBox))),
              HasSubstr("<intervalStart> in <velocity> is not regarded"));
  EXPECT_THAT(refusal(problem(kPosition + exact("orientation", "0.5") + exact("time", "3") +
                                  exact("velocity", "0"),
                              goal(kBox))),
              HasSubstr("<time> of <initialState> is 3, must be 0"));
}

TEST(PlanningProblems, ThatAreIncompleteAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal(""), HasSubstr("no <planningProblem>, at least one is needed"));
  EXPECT_THAT(refusal(problem(kInitial, "")), HasSubstr("needs a <goalState>"));
  EXPECT_THAT(refusal(problem(kInitial, "<goalState>" + kTime + "</goalState>")),
              HasSubstr("file.xml:2: <goalState> needs a <position>"));
  EXPECT_THAT(refusal(problem(kInitial, goal(""))), HasSubstr("<position> is empty"));
  EXPECT_THAT(refusal(problem(kInitial, goal(kBox, interval("time", "9", "8")))),
              HasSubstr("<time> is from 9 to 8, must be from the smaller number"));
  EXPECT_THAT(refusal(problem(kInitial, goal(kBox)) + problem(kInitial, goal(kBox))),
              HasSubstr("<planningProblem> id 100 is taken already, must be unique"));
  const std::string bent =
      "<polygon><point><x>0</x><y>0</y></point><point><x>9</x><y>0</y></point>"
      "<point><x>1</x><y>1</y></point><point><x>0</x><y>9</y></point></polygon>";
  EXPECT_THAT(refusal(problem(kInitial, goal(bent))), HasSubstr("<polygon> is not convex"));
}

TEST(PlanningProblems, NeedTheLengthOfATimeStep) {
  for (const std::string step : {"0", "-1", "fast", "", "1e9"}) {
    EXPECT_THROW(static_cast<void>(read(file_with(problem(kInitial, goal(kBox)), "2020a", step))),
                 std::runtime_error)
        << step;
  }
}

}  // namespace
}  // namespace hlc::road::planning_problem_test
