// Reference speeds of a scenario's vehicles and of sections of its routes, and what is refused.
#include "planner/scenario/reference_speeds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "planner/common/text_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::reference_speeds_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The shipped scenario `speeds`: red drives [1 ... 10], of these 4 and 5 at 0.4 m/s, at its own
/// 0.6 m/s.
const std::string kOwn = "reference_speed_mps: 0.6}";
const std::string kSection = "[{from: 4, to: 5, reference_speed_mps: 0.4}]";

Scenario speeds(const test::TextChanges& changes = {}, ScenarioChoices choices = {}) {
  return test::changed_scenario("speeds", "", changes, std::move(choices));
}

std::string error_with_section(const std::string& section) {
  return test::error_of_scenario("speeds", "", {{kSection, "[" + section + "]"}});
}

const road::SpeedSection& section_of(const ScenarioVehicle& vehicle) {
  EXPECT_EQ(vehicle.speed_sections.size(), 1U);
  return vehicle.speed_sections.front();
}

TEST(ReferenceSpeeds, AreTheVehiclesOwnOrTheScenarios) {
  const Scenario scenario = speeds();
  EXPECT_EQ(make_controller(scenario, {1})->options().reference_speed_mps, 0.6);
  EXPECT_EQ(make_controller(scenario, {2})->options().reference_speed_mps, 0.8);
  EXPECT_EQ(make_controller(scenario, {9})->options().reference_speed_mps, 0.8)
      << "a vehicle that the scenario does not name";
}

TEST(ReferenceSpeeds, LeaveACarTheTrimsThatItNeeds) {
  const Scenario scenario = speeds();
  const auto top_mps = [&](double reference_speed_mps) {
    const auto on = subgraph_at(scenario.subgraph, reference_speed_mps, scenario.horizon_steps);
    return on == scenario.subgraph ? -1.0 : on->spec().max_speed_mps.value();
  };
  EXPECT_EQ(top_mps(0.3), 0.4);
  EXPECT_EQ(top_mps(0.4), 0.4);
  EXPECT_EQ(top_mps(0.41), 0.6);
  EXPECT_EQ(top_mps(0.61), -1.0) << "0.8 m/s is the fastest";
  EXPECT_EQ(make_controller(scenario, {1})->subgraph().spec().max_speed_mps, 0.6);
  EXPECT_EQ(make_controller(scenario, {2})->prepared_subgraph().subgraph, scenario.subgraph);
  // Of the paper's trims only the fastest are straight: a car needs them at any speed.
  const Scenario paper = test::changed_scenario("paper_red_alone", "");
  EXPECT_EQ(subgraph_at(paper.subgraph, 0.5, 8), paper.subgraph);
}

TEST(ReferenceSpeeds, OfSectionsHoldFromTheBeginOfTheFirstLaneletToTheEndOfTheLast) {
  const Scenario scenario = speeds();
  const ScenarioVehicle& red = scenario.vehicles.front();
  const road::SpeedSection& section = section_of(red);
  EXPECT_EQ(section.speed_mps, 0.4);
  const road::LaneletMap map = road::read_lanelet_map(*scenario.map_file);
  const auto first_of = [&](int lanelet) { return map.lanelets.at(lanelet).left_m.front(); };
  EXPECT_LT((red.path.at(section.from_s_m) - first_of(4)).norm(), 0.12);
  EXPECT_LT((red.path.at(section.to_s_m) - first_of(6)).norm(), 0.12);
  EXPECT_EQ(make_controller(scenario, {1})->route().speed_sections.size(), 1U);
  for (const road::DrivableRoute& route : scenario.routes) {
    EXPECT_EQ(route.speed_sections.size(), 1U) << "for vehicles that it does not name";
  }
}

TEST(ReferenceSpeeds, OfSectionsGoOnWhereTheRouteBeginsAgain) {
  const Scenario scenario = speeds({{kSection, "[{from: 10, to: 1, reference_speed_mps: 0.4}]"}});
  const ScenarioVehicle& red = scenario.vehicles.front();
  const road::SpeedSection& section = section_of(red);
  EXPECT_LT(section.from_s_m, red.path.length_m());
  EXPECT_GT(section.to_s_m, red.path.length_m());
  EXPECT_LT(section.to_s_m, section.from_s_m + red.path.length_m());
}

/// Red has one map only: a route that begins elsewhere does so on all of them.
const test::TextChanges kOneMap{
    {"      C-ZAM_AC-1_1_T-1: [41, 39, 20, 63, 61, 57, 55, 67, 65, 98, 37, 35, 31, 29]\n", ""},
    {"      C-ZAM_AC-1_1_T-1: [{from: 57, to: 55, reference_speed_mps: 0.4}]\n", ""}};

TEST(ReferenceSpeeds, OfSectionsStayWhereTheyAreOnARouteThatBeginsElsewhere) {
  const Scenario scenario = speeds({kOneMap[0],
                                    kOneMap[1],
                                    {"route: red, start_m: 0.0", "route: late, start_m: 0.0"},
                                    {"  - name: blue",
                                     "  - {name: late, of: red, from: 5}\n"
                                     "  - name: blue"}});
  const ScenarioVehicle& late = scenario.vehicles.front();
  const Scenario shipped = speeds();
  const ScenarioVehicle& red = shipped.vehicles.front();
  const auto begin_m = [](const ScenarioVehicle& one) {
    return one.path.at(section_of(one).from_s_m);
  };
  EXPECT_GT(section_of(late).to_s_m, late.path.length_m()) << "it begins within the section";
  EXPECT_LT((begin_m(late) - begin_m(red)).norm(), 1e-6);
}

TEST(ReferenceSpeeds, OfSectionsHoldOnTheWayToAGoalInTheNextLap) {
  const Scenario shipped = speeds();
  const Point before_start_m = shipped.vehicles.front().path.at(-0.4);
  const std::string goal = "goal: {circle: {x_m: " + std::to_string(before_start_m.x()) +
                           ", y_m: " + std::to_string(before_start_m.y()) + ", radius_m: 0.2}}, ";
  const Scenario scenario =
      speeds({{"route: red, start_m: 0.0, ", "route: red, start_m: 12.2, " + goal}});
  const ScenarioVehicle& red = scenario.vehicles.front();
  EXPECT_FALSE(red.path.is_closed());
  ASSERT_EQ(red.speed_sections.size(), 2U);
  const double lap_m = shipped.vehicles.front().path.length_m();
  EXPECT_NEAR(red.speed_sections[1].from_s_m, red.speed_sections[0].from_s_m + lap_m, 1e-9);
}

TEST(ReferenceSpeeds, OfSectionsAreNoneOnRandomRoutes) {
  for (const ScenarioVehicle& one : speeds({}, {.routes = kRandomRoutes}).vehicles) {
    EXPECT_TRUE(one.speed_sections.empty());
  }
}

TEST(ReferenceSpeeds, ThatNoCarDrivesAreRefused) {
  const auto error_with_own = [](const std::string& speed) {
    return test::error_of_scenario("speeds", "", {{kOwn, "reference_speed_mps: " + speed + "}"}});
  };
  EXPECT_THAT(error_with_own("-0.5"),
              HasSubstr("scenario.yaml:14: vehicles[1].reference_speed_mps = -0.5, must be a "
                        "number > 0"));
  EXPECT_THAT(error_with_own("0"), HasSubstr("must be a number > 0"));
  EXPECT_THAT(error_with_own("0.9"),
              HasSubstr("vehicles[1].reference_speed_mps = 0.9, must be <= 0.8, the speed of the "
                        "fastest trim of subgraph J2"));
  EXPECT_THAT(error_with_section("{from: 4, to: 5, reference_speed_mps: -1}"),
              HasSubstr("must be a number > 0"));
  EXPECT_THAT(error_with_section("{from: 4, to: 5, reference_speed_mps: 1}"),
              HasSubstr("must be <= 0.8, the speed of the fastest trim of subgraph J2"));
  EXPECT_THAT(
      test::error_of_scenario("speeds", "",
                              {{"reference_speed_mps: 0.8", "reference_speed_mps: 0.5"},
                               {kSection, "[{from: 4, to: 5, reference_speed_mps: 0.7}]"}}),
      HasSubstr("sections.ZAM_LabLike-1_1_T-1[1].reference_speed_mps = 0.7, must be <= 0.6, the "
                "highest reference speed of a vehicle: a section makes none faster"));
}

TEST(ReferenceSpeeds, OfAScenarioAreAtMostThoseOfAnyVehicle) {
  const auto error_with = [](const std::string& speed) {
    return test::error_of_scenario("speeds", "",
                                   {{"reference_speed_mps: 0.8", "reference_speed_mps: " + speed}});
  };
  for (const char* speed : {"1e300", "1001"}) {
    EXPECT_THAT(error_with(speed), HasSubstr("reference_speed_mps = " + std::string(speed)));
    EXPECT_THAT(error_with(speed), HasSubstr("<= 1000"));
  }
}

TEST(ReferenceSpeeds, AtWhichACarCouldNotStartAndStopAreRefused) {
  // Of this subgraph only the fast trim is next to standstill.
  const test::TemporaryFolder folder;
  const std::string automaton = (folder / "fast.yaml").string();
  std::ofstream(automaton) << read_file(test::source_folder() +
                                        "/launch_scripts/automata/ucar_speeds.yaml")
                           << "  - {name: fast, label: J2, trims: [1, 4, 14], rule: reachable, "
                              "disabled_edges: [{from: 1, to: 4}, {from: 4, to: 1}]}\n";
  EXPECT_THAT(
      test::error_of_scenario("speeds", "",
                              {{"../automata/ucar_speeds.yaml", automaton},
                               {"subgraph: J2", "subgraph: fast"},
                               {kOwn, "reference_speed_mps: 0.4}"}}),
      HasSubstr("vehicles[1].reference_speed_mps = 0.4, must be one at which the car can stop: "));
}

TEST(ReferenceSpeeds, OfSectionsThatTheRouteDoesNotHaveAreRefused) {
  EXPECT_THAT(error_with_section("{from: 4, to: 20, reference_speed_mps: 0.4}"),
              AllOf(HasSubstr("routes[1].sections.ZAM_LabLike-1_1_T-1[1].to = 20"),
                    HasSubstr("must be a lanelet that the route drives, and drives once")));
  EXPECT_THAT(error_with_section("{from: 99, to: 5, reference_speed_mps: 0.4}"),
              HasSubstr("from = 99, must be a lanelet that the route drives"));
  EXPECT_THAT(error_with_section("{from: 4, to: 5, reference_speed_mps: 0.4}, {from: 5, to: 6, "
                                 "reference_speed_mps: 0.5}"),
              HasSubstr("sections.ZAM_LabLike-1_1_T-1[2].from = 5, must be the first of lanelets "
                        "in no section above; lanelet 5 is in one"));
  EXPECT_THAT(error_with_section("{from: 9, to: 2, reference_speed_mps: 0.4}, {from: 1, to: 1, "
                                 "reference_speed_mps: 0.5}"),
              HasSubstr("lanelet 1 is in one"));
  EXPECT_THAT(error_with_section("{from: 4, to: 5, max_mps: 0.4}"),
              HasSubstr("reference_speed_mps is missing"));
  EXPECT_THAT(test::error_of_scenario("speeds", "",
                                      {{"    sections:\n      ZAM_LabLike-1_1_T-1: ",
                                        "    sections:\n      ZAM_Other-1: "}}),
              HasSubstr("must be of a map for which the route has `lanelets`"));
  EXPECT_THAT(test::error_of_scenario("speeds", "",
                                      {{"      ZAM_LabLike-1_1_T-1: " + kSection + "\n", ""}}),
              HasSubstr("must be a list for the map with benchmarkID ZAM_LabLike-1_1_T-1"));
}

TEST(ReferenceSpeeds, OfSectionsOnAnOpenRouteDoNotGoOnAtItsBegin) {
  EXPECT_THAT(test::error_of_scenario("speeds", "",
                                      {{"closed: true", "closed: false"},
                                       {kSection, "[{from: 5, to: 4, reference_speed_mps: 0.4}]"}}),
              HasSubstr("to = 4, must be `from` or a lanelet after it: the route is open"));
}

}  // namespace
}  // namespace hlc::scenario::reference_speeds_test
