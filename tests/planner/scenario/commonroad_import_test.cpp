#include "planner/scenario/commonroad_import.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <exception>
#include <string>

#include "planner/common/text_file.hpp"
#include "tests/support/commonroad_samples.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::commonroad_import_test {
namespace {

using test::CommonRoadSketch;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kScenarios =
    std::filesystem::path(test::source_folder()) / "launch_scripts/scenarios";

constexpr Pose kStart{10.0, 0.0, 0.0};

std::string box_at(double x_m) { return test::rectangle_at({x_m, 0.0, 0.0}, {10.0, 3.0}); }

CommonRoadSketch one_lane() {
  return CommonRoadSketch().lane(1, test::straight({0.0, 0.0}, {100.0, 0.0}));
}

class CommonRoadImports : public testing::Test {
 protected:
  [[nodiscard]] ImportedScenario imported(const std::string& xml,
                                          bool from_standstill = false) const {
    write_file(file(), xml);
    return scenario_from_commonroad({.file = file(),
                                     .like = like_,
                                     .from_standstill = from_standstill,
                                     .out = folder_ / "out.yaml"});
  }
  [[nodiscard]] ImportedScenario imported(const CommonRoadSketch& sketch,
                                          bool from_standstill = false) const {
    return imported(sketch.xml(), from_standstill);
  }
  template <class File>
  [[nodiscard]] std::string refusal(const File& content) const {
    try {
      static_cast<void>(imported(content));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "problem.xml"; }

  const test::TemporaryFolder folder_;
  std::filesystem::path like_{kScenarios / "passenger_cars_in_town.yaml"};
};

TEST_F(CommonRoadImports, AreThePlanningProblemsWithTheVehicleOfAnotherScenario) {
  const auto [text, scenario] = imported(one_lane()
                                             .parked_car(50, {90.0, 0.0, 0.0})
                                             .problem(31, {30.0, 0.2, 0.1}, {box_at(75.0)})
                                             .problem(12, kStart, {box_at(55.0)}));
  const Scenario like = read_scenario({.file = like_});
  EXPECT_EQ(scenario.name, "ZAM_Sketch-1_1_T-1");
  EXPECT_EQ(scenario.steps, 120U) << "60 s in steps of 0.5 s";
  EXPECT_EQ(scenario.automaton_file, like.automaton_file);
  EXPECT_EQ(scenario.subgraph->spec().name, like.subgraph->spec().name);
  EXPECT_EQ(scenario.horizon_steps, like.horizon_steps);
  EXPECT_EQ(scenario.reference_speed_mps, like.reference_speed_mps);
  EXPECT_EQ(scenario.contouring_weight, like.contouring_weight);
  EXPECT_EQ(scenario.search.max_expansions, like.search.max_expansions);
  ASSERT_EQ(scenario.obstacles.size(), 1U);
  ASSERT_EQ(scenario.vehicles.size(), 2U);
  const ScenarioVehicle& first = scenario.vehicles[0];
  EXPECT_EQ(first.name, "problem 31");
  EXPECT_NEAR(first.start.x_m, 30.0, 1e-6);
  EXPECT_NEAR(first.start.y_m, 0.2, 1e-6);
  EXPECT_NEAR(first.start.heading_rad, 0.1, 1e-6);
  EXPECT_FALSE(first.path.is_closed());
  EXPECT_NEAR(first.path.at(first.path.length_m()).x(), 75.0, 1e-6);
  ASSERT_TRUE(first.goal);
  EXPECT_EQ(scenario.vehicles[1].name, "problem 12");
}

TEST_F(CommonRoadImports, ReadBackFromTheirFileToTheSame) {
  const auto [text, scenario] = imported(one_lane().problem(7, kStart, {box_at(55.0)}));
  write_file(folder_ / "out.yaml", text);
  const Scenario again = read_scenario({.file = folder_ / "out.yaml"});
  EXPECT_EQ(again.vehicles.at(0).start, scenario.vehicles.at(0).start);
  EXPECT_EQ(again.vehicles[0].goal->area_m, scenario.vehicles[0].goal->area_m);
  EXPECT_EQ(again.map_file, file());
  EXPECT_THAT(text, HasSubstr("map: \"problem.xml\"\n")) << "beside it: both can move";
}

TEST_F(CommonRoadImports, TakeNoPlacesVehiclesOrRulesForThemFromTheOtherScenario) {
  for (const char* name : {"reconfiguration", "lab_guest", "speeds", "obstacle_field"}) {
    SCOPED_TRACE(name);
    like_ = kScenarios / (std::string(name) + ".yaml");
    CommonRoadSketch sketch;
    sketch.lane(1, test::straight({0.0, 0.0}, {4.0, 0.0}), 0.3)
        .problem(7, {0.3, 0.0, 0.0}, {test::rectangle_at({3.0, 0.0, 0.0}, {0.5, 0.2})});
    const Scenario scenario = imported(sketch).scenario;
    EXPECT_EQ(scenario.vehicles.size(), 1U);
    EXPECT_TRUE(scenario.guests.empty());
    EXPECT_TRUE(scenario.obstacles.empty());
    EXPECT_TRUE(scenario.policies.empty());
    EXPECT_EQ(scenario.lab_file, read_scenario({.file = like_}).lab_file);
  }
}

TEST_F(CommonRoadImports, KeepTheFurtherRulesOfTheOtherScenario) {
  std::string text = read_file(like_);
  text.replace(text.find("../"), 3, (kScenarios / "../").string());
  text.replace(text.find("../automata"), 3, (kScenarios / "../").string());
  like_ = folder_ / "like.yaml";
  write_file(like_, text +
                        "priorities: {strategy: fca, first: [2], max_levels: 3}\n"
                        "criterion_weights: {J2: 0.001}\nrounds: two\n");
  const Scenario scenario = imported(one_lane().problem(7, kStart, {box_at(55.0)})).scenario;
  const Scenario like = read_scenario({.file = like_});
  EXPECT_EQ(scenario.rounds, controller::Rounds::kTwo);
  EXPECT_EQ(scenario.profile.strategies.priorities.strategy,
            like.profile.strategies.priorities.strategy);
  EXPECT_EQ(scenario.profile.strategies.priorities.first, like.profile.strategies.priorities.first);
  EXPECT_EQ(scenario.search.criterion_weights.size(), 1U);
}

TEST_F(CommonRoadImports, OfMovingVehiclesAreRefusedUnlessTheyBeginStanding) {
  const CommonRoadSketch sketch = one_lane().problem(7, kStart, {box_at(55.0)}, 8.5);
  EXPECT_THAT(
      refusal(sketch),
      HasSubstr("problem.xml: planning problem 7: velocity of the initial state is 8.5 m/s, "
                "must be 0: vehicles begin standing; with --from_standstill true"));
  EXPECT_EQ(imported(sketch, true).scenario.vehicles.size(), 1U);
  for (const std::string name : {"yawRate", "slipAngle"}) {
    std::string xml = one_lane().problem(7, kStart, {box_at(55.0)}).xml();
    const std::string zero = "<" + name + "><exact>0<";
    xml.replace(xml.find(zero), zero.size(), "<" + name + "><exact>0.2<");
    EXPECT_THAT(refusal(xml), HasSubstr("7: " + name + " of the initial state is 0.2 rad"));
  }
}

TEST_F(CommonRoadImports, EndAtTheEarliestEndOfTheGoalsTimes) {
  const auto timed = [](std::string xml, const std::string& from, const std::string& to) {
    const std::string all = "<intervalStart>0</intervalStart><intervalEnd>600</intervalEnd>";
    return xml.replace(
        xml.find(all), all.size(),
        "<intervalStart>" + from + "</intervalStart><intervalEnd>" + to + "</intervalEnd>");
  };
  const std::string two = one_lane()
                              .problem(7, {30.0, 0.0, 0.0}, {box_at(75.0)})
                              .problem(8, kStart, {box_at(55.0)})
                              .xml();
  EXPECT_EQ(imported(timed(two, "0", "204")).scenario.steps, 40U) << "20.4 s in steps of 0.5 s";
  EXPECT_EQ(imported(timed(two, "590", "605")).scenario.steps, 120U);
  EXPECT_THAT(refusal(timed(two, "602", "700")),
              HasSubstr("planning problem 7: time of the goal state is in 60.2 ... 70 s, must"));
  EXPECT_THAT(refusal(timed(two, "0", "4")), HasSubstr("must end after the first step of 0.5 s"));
}

TEST_F(CommonRoadImports, ThatCannotBeDrivenAreRefusedByWhatIsInTheFile) {
  const std::string goal = box_at(75.0);
  EXPECT_THAT(
      refusal(one_lane().problem(7, kStart, {goal}).element("<dynamicObstacle id=\"77\"/>")),
      HasSubstr("<dynamicObstacle> \"77\": is not regarded, must be absent"));
  EXPECT_THAT(refusal(one_lane().problem(7, kStart, {goal}).element("<weather/>")),
              HasSubstr("<weather> is not regarded"));
  EXPECT_THAT(refusal(one_lane().problem(7, kStart, {test::lanelet_ref(5)})),
              HasSubstr("problem.xml: planning problem 7: position of the goal state has lanelet"));
  EXPECT_THAT(refusal(one_lane().problem(7, kStart, {goal}).problem(8, kStart, {goal})),
              HasSubstr("start poses whose footprints with margin do not overlap"));
  EXPECT_THAT(refusal(one_lane().parked_car(50, kStart).problem(7, kStart, {goal})),
              HasSubstr("parkedVehicle 50"));
  CommonRoadSketch many = one_lane();
  for (int id = 1; id <= 31; ++id) many.problem(id, kStart, {goal});
  EXPECT_THAT(refusal(many), HasSubstr("planning problems = 31, must be <= 30"));
}

TEST_F(CommonRoadImports, OfNoFileAreRefused) {
  EXPECT_THAT(refusal(std::string("no XML")), HasSubstr("problem.xml:1: not well-formed XML"));
  EXPECT_THROW(static_cast<void>(scenario_from_commonroad(
                   {.file = folder_ / "none.xml", .like = like_, .out = folder_ / "out.yaml"})),
               std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::commonroad_import_test
