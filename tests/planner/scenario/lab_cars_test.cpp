// Cars drawn on the lab's road network, and random routes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>

#include "planner/road/lap.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/right_of_way.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "planner/search/horizon_problem.hpp"
#include "tests/planner/scenario/changed_scenario.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::lab_cars_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kLaunchScripts = test::source_folder() + "/launch_scripts/";

ScenarioChoices lab_cars() { return {.file = kLaunchScripts + "scenarios/lab_cars.yaml"}; }

std::vector<std::string> names_of(const std::vector<ScenarioVehicle>& vehicles) {
  std::vector<std::string> names;
  for (const ScenarioVehicle& vehicle : vehicles) names.push_back(vehicle.name);
  return names;
}

TEST(LabCars, CandidatesAreTheAuthorsPathsFromNineOn) {
  const std::vector<road::LaneletId> starts{1,  10, 17,  38, 49, 64, 75, 79, 88, 95, 42,
                                            45, 92, 100, 33, 22, 59, 68, 19, 14, 39, 61,
                                            55, 65, 35,  29, 15, 5,  11, 93, 83, 89, 71};
  const Scenario scenario = read_scenario(lab_cars());
  ASSERT_EQ(scenario.candidates.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(scenario.candidates[i].name, "path " + std::to_string(i + 9));
    EXPECT_EQ(scenario.candidates[i].start_lanelet, starts[i]);
    EXPECT_EQ(scenario.candidates[i].start_s_m, 0.0);
  }
  ASSERT_EQ(scenario.routes.size(), 7U);
  EXPECT_EQ(scenario.routes.front().name, "loop 1");
}

TEST(LabCars, ARouteOnWhichACarCouldWaitNowhereIsRefused) {
  ScenarioChoices choices = lab_cars();
  choices.cars = 2;
  Scenario scenario = read_scenario(choices);
  std::vector<Point> points_m = scenario.vehicles[0].path.points_m();
  std::ranges::reverse(points_m);
  scenario.vehicles[1].path = {points_m, true};
  const std::string name = scenario.vehicles[0].name;
  try {
    relate_routes(scenario);
    FAIL() << "the same lane in both directions";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("lab_cars.yaml: right_of_way: "),
                                    HasSubstr("vehicle 1 (" + name + ")")));
  }
}

TEST(LabCars, CarsOfFewTrimsHaveMoreRoomWhereTheyStop) {
  EXPECT_EQ(read_scenario(lab_cars()).conflicts->stopping_room_m(), 0.0);
  const Scenario few_trims = test::changed_scenario(
      "lab_cars", "", {{"ucar_traffic_49", "paper"}, {"subgraph: J2", "subgraph: B"}}, {});
  EXPECT_NEAR(few_trims.conflicts->stopping_room_m(), 0.0051, 0.0001);
}

TEST(LabCars, DrawsDifferentPathsWhoseStartsDoNotOverlap) {
  const Scenario scenario = read_scenario(lab_cars());
  ASSERT_EQ(scenario.vehicles.size(), 20U);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario drawn = with_random_starts(scenario, seed);
    const std::vector<std::string> names = names_of(drawn.vehicles);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 20U);
    EXPECT_FALSE(overlapping_starts(drawn));
    EXPECT_EQ(names, names_of(with_random_starts(scenario, seed).vehicles));
  }
}

TEST(LabCars, ADrawIsTheSameOnEveryMachine) {
  ScenarioChoices choices = lab_cars();
  choices.cars = 5;
  EXPECT_THAT(names_of(read_scenario(choices).vehicles),
              ElementsAre("path 11", "path 23", "path 12", "path 15", "path 24"));
  choices.seed = 2;
  const Scenario other = read_scenario(choices);
  EXPECT_THAT(names_of(other.vehicles),
              ElementsAre("path 36", "path 34", "path 21", "path 32", "path 11"));
  EXPECT_EQ(names_of(with_random_starts(read_scenario(lab_cars()), 2).vehicles).front(), "path 36");
  EXPECT_EQ(other.vehicles[4].id.value, 5);
}

TEST(LabCars, MoreCarsThanPathsStandAtFurtherLaneletsOfTheirLoops) {
  ScenarioChoices choices = lab_cars();
  choices.cars = 33;
  const Scenario paths = read_scenario(choices);
  EXPECT_TRUE(paths.further_candidates.empty());
  choices.cars = 50;
  const Scenario scenario = read_scenario(choices);
  ASSERT_EQ(scenario.vehicles.size(), 50U);
  EXPECT_FALSE(overlapping_starts(scenario));
  const std::vector<std::string> names = names_of(scenario.vehicles);
  const std::vector<std::string> first = names_of(paths.vehicles);
  EXPECT_TRUE(std::ranges::equal(std::span(names).first(33), first)) << "the paths' begins before";
  for (std::size_t i = 33; i < 50; ++i) {
    const ScenarioVehicle& vehicle = scenario.vehicles[i];
    EXPECT_GT(vehicle.start_s_m, 0.0);
    EXPECT_LT((vehicle.path.at(vehicle.start_s_m) - vehicle.start.position_m()).norm(), 1e-9);
    EXPECT_TRUE(vehicle.name.ends_with(" at " + std::to_string(vehicle.start_lanelet)))
        << vehicle.name;
  }
  EXPECT_EQ(with_random_starts(scenario, 2).vehicles.size(), 50U);
}

// If one moved the car by rounding alone, each step of a plan could turn them (turns_in_place).
TEST(LabCars, AStandingCarTurnsItsWheelsWhereItStands) {
  const Scenario scenario = read_scenario(lab_cars());
  const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
  std::size_t turns = 0;
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) {
    const auto stands = [&](TrimId trim) { return automaton.trims[trim.index].is_equilibrium(); };
    if (!stands(maneuver.from) || !stands(maneuver.to) || maneuver.from == maneuver.to) continue;
    EXPECT_TRUE(search::turns_in_place(maneuver))
        << maneuver.from.index << " -> " << maneuver.to.index;
    ++turns;
  }
  EXPECT_EQ(turns, 4U) << "straight to left and right, and back";
}

TEST(LabCars, FiftyCarsDrive) {
  ScenarioChoices choices = lab_cars();
  choices.cars = 50;
  const Scenario scenario = read_scenario(choices);
  rollout::Rollout rollout = rollout::make_rollout(scenario);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    const std::vector<coordination::Report> reports = rollout.step();
    ASSERT_EQ(reports.size(), 50U);
    moved = static_cast<std::size_t>(
        std::ranges::count_if(reports, [&](const coordination::Report& report) {
          const Pose& start = vehicle_of(scenario, report.vehicle).start;
          return (report.planned_pose.position_m() - start.position_m()).norm() > 0.1;
        }));
  }
  EXPECT_GT(moved, 10U);
  EXPECT_EQ(rollout.controllers().back()->options().vehicle, VehicleId{50});
}

TEST(LabCars, StartsAreTheSameOnTheLabsMap) {
  ScenarioChoices choices = lab_cars();
  choices.map_file = test::source_folder() + "/../shared/data/LabMapCommonRoad.xml";
  if (!std::filesystem::exists(*choices.map_file)) {
    GTEST_SKIP() << "the lab's map is not here: " << *choices.map_file;
  }
  const Scenario on_labs = read_scenario(choices);
  const Scenario on_ours = read_scenario(lab_cars());
  EXPECT_EQ(names_of(on_labs.vehicles), names_of(on_ours.vehicles));
  for (std::size_t i = 0; i < on_ours.candidates.size(); ++i) {
    const ScenarioVehicle& ours = on_ours.candidates[i];
    const ScenarioVehicle& labs = on_labs.candidates[i];
    EXPECT_LT((ours.start.position_m() - labs.start.position_m()).norm(), 0.002) << ours.name;
    EXPECT_NEAR(ours.path.length_m(), labs.path.length_m(), 0.01) << ours.name;
    for (const Point& point : labs.path.points_m()) {
      EXPECT_LT(ours.path.project(point).distance_m, 0.002) << ours.name;
    }
  }
}

/// The error of reading a scenario that is lab_cars except for the text from `from` to `end`.
std::string error_of(const std::string& from, const std::string& to, const std::string& end = "") {
  std::ifstream good(kLaunchScripts + "scenarios/lab_cars.yaml");
  std::string text((std::istreambuf_iterator<char>(good)), {});
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, text.find(end, at + from.size()) + end.size() - at, to);
  for (std::size_t place = 0; (place = text.find("../", place)) != std::string::npos;) {
    text.replace(place, 3, kLaunchScripts);
  }
  const test::TemporaryFolder folder;
  const std::string file = folder / "scenario.yaml";
  std::ofstream(file) << text;
  try {
    static_cast<void>(read_scenario({.file = file}));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(LabCars, MoreCarsThanFitAreRefusedWithHowManyDo) {
  EXPECT_EQ(error_of("cars: 20", "cars: 60"), "");
  EXPECT_THAT(error_of("cars: 20", "cars: 61"),
              HasSubstr(".yaml:18: draw.cars = 61, must be in 1 ... 60: no more cars fit"));
  EXPECT_THAT(error_of("cars: 20", "cars: 256"),
              HasSubstr("draw.cars = 256, must be a whole number >= 1 and <= 255"));
  // One loop of twelve lanelets.
  EXPECT_THAT(error_of("[path 9,", "[path 9, path 11, path 9]", "]"),
              HasSubstr(".yaml:18: draw.cars = 20, must be in 1 ... 12: no more cars fit"));
}

TEST(LabCars, UnknownRoutesAreNamedWithTheirPlaces) {
  EXPECT_THAT(error_of("[path 9,", "[path 99,"),
              HasSubstr(".yaml:19: draw.routes[1] = path 99, must be the name of"));
  EXPECT_THAT(error_of("of: loop 2, from: 10", "of: loop 9, from: 10"),
              HasSubstr("of = loop 9, must be the name of a closed route above"));
  EXPECT_THAT(error_of("of: loop 2, from: 10", "of: loop 2, from: 999"),
              HasSubstr("from = 999, must be a lanelet of loop 2"));
}

TEST(LabCars, FlagsThatFitNoOtherScenarioAreRefused) {
  const auto error = [](const ScenarioChoices& choices) -> std::string {
    try {
      static_cast<void>(read_scenario(choices));
    } catch (const std::exception& thrown) {
      return thrown.what();
    }
    return "";
  };
  const std::string circle = kLaunchScripts + "scenarios/circle.yaml";
  EXPECT_THAT(error({.file = circle, .seed = 1}), HasSubstr("--seed"));
  EXPECT_THAT(error({.file = circle, .routes = kRandomRoutes}), HasSubstr("--routes"));
  const std::string three = kLaunchScripts + "scenarios/paper_three_cars.yaml";
  EXPECT_THAT(error({.file = three, .seed = 1}), HasSubstr("--seed"));
  EXPECT_THAT(error({.file = three, .routes = "some"}),
              HasSubstr("--routes = some, must be random"));
  EXPECT_EQ(error({.file = three, .seed = 1, .routes = kRandomRoutes}), "");
}

TEST(RandomRoutes, EveryCarHasItsOwnClosedOneThroughItsStart) {
  ScenarioChoices choices = lab_cars();
  const Scenario named = read_scenario(choices);
  choices.routes = kRandomRoutes;
  const Scenario random = read_scenario(choices);
  ASSERT_EQ(names_of(random.vehicles), names_of(named.vehicles));
  std::set<double> lengths_m;
  for (std::size_t i = 0; i < random.vehicles.size(); ++i) {
    const ScenarioVehicle& car = random.vehicles[i];
    EXPECT_TRUE(car.path.is_closed());
    EXPECT_GT(car.path.length_m(), 150.0);
    EXPECT_EQ(car.start, named.vehicles[i].start);
    EXPECT_LT((car.path.at(car.start_s_m) - car.start.position_m()).norm(), 1e-9);
    lengths_m.insert(car.path.length_m());
  }
  EXPECT_EQ(lengths_m.size(), random.vehicles.size());
  EXPECT_EQ(random.routes.size(), random.vehicles.size());
  EXPECT_EQ(with_random_starts(random, 1).vehicles[0].path.points_m(),
            random.vehicles[0].path.points_m());
  EXPECT_NE(with_random_starts(random, 2).vehicles[0].path.points_m(),
            random.vehicles[0].path.points_m());
}

TEST(RandomRoutes, ACarDrivesRoundItsWholeRouteWithoutAStop) {
  ScenarioChoices choices = lab_cars();
  choices.routes = kRandomRoutes;
  choices.cars = 1;
  const Scenario scenario = read_scenario(choices);
  const ScenarioVehicle& car = scenario.vehicles.front();
  rollout::Rollout rollout = rollout::make_rollout(scenario);
  std::vector<Point> positions_m;
  int num_askew = 0;  // a plan that would end askew is dropped, and the one in force leads on
  for (int step = 0; step < 1800; ++step) {
    const std::vector<coordination::Report> reports = rollout.step();
    if (reports.front().status == coordination::StepStatus::kFallback) {
      ASSERT_EQ(reports.front().reason, coordination::FallbackReason::kInfeasible) << step;
      ++num_askew;
    }
    positions_m.push_back(reports.front().planned_pose.position_m());
    if (step > 20) {
      ASSERT_GT((positions_m.back() - positions_m[positions_m.size() - 11]).norm(), 0.1) << step;
    }
  }
  EXPECT_LE(num_askew, 1);
  const road::Progress progress = road::progress_along(car.path, positions_m);
  EXPECT_GT(progress.s_m.back() - progress.s_m.front(), car.path.length_m());
  EXPECT_LT(*std::ranges::max_element(progress.distance_m), 0.2);
}

/// One car in a lanelet of the lab's network.
std::string error_of_random(const std::string& routes, const std::string& vehicle) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scenario.yaml";
  std::ofstream(file) << "name: one\nsteps: 10\nmap: " << kLaunchScripts
                      << "maps/lab_network.xml\nautomaton: " << kLaunchScripts
                      << "automata/paper.yaml\nsubgraph: B\nseed: 3\nroutes: " << routes
                      << "\nvehicles:\n  - {id: 1, " << vehicle << "}\n";
  try {
    const Scenario scenario = read_scenario({.file = file});
    EXPECT_EQ(scenario.seed, 3U);
    EXPECT_TRUE(scenario.random_routes_on);
    EXPECT_EQ(scenario.vehicles.front().start_lanelet, 22);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(RandomRoutes, OfAScenarioBeginInTheVehiclesLanelets) {
  EXPECT_EQ(error_of_random("random", "lanelet: 22, start_m: 0.1"), "");
  EXPECT_THAT(error_of_random("some", "lanelet: 22, start_m: 0.1"),
              HasSubstr(".yaml:7: routes = some, must be random"));
  EXPECT_THAT(error_of_random("random", "lanelet: 999, start_m: 0.1"),
              AllOf(HasSubstr(".yaml:9: vehicles[1].lanelet = 999, must be a lanelet of the map"),
                    HasSubstr("999 is not in the map")));
  EXPECT_THAT(error_of_random("random", "lanelet: 22, start_m: 5"), HasSubstr("start_m = 5"));
  EXPECT_THAT(error_of_random("random", "route: red, start_m: 5"), HasSubstr("lanelet"));
}

TEST(RandomRoutes, AStartWithoutAWayBackIsRefusedByItsLanelet) {
  std::ifstream good(kLaunchScripts + "maps/lab_network.xml");
  std::string map((std::istreambuf_iterator<char>(good)), {});
  // Lanelet 13, the only one that leads to 15, no longer has a predecessor.
  for (const char* to_13 : {"<successor ref=\"13\"/>"}) {
    for (std::size_t at = 0; (at = map.find(to_13, at)) != std::string::npos;) {
      map.erase(at, std::string(to_13).size());
    }
  }
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "map.xml";
  std::ofstream(file) << map;
  ScenarioChoices choices = lab_cars();
  choices.map_file = file;
  choices.routes = kRandomRoutes;
  choices.cars = 30;
  EXPECT_THAT([&] { static_cast<void>(read_scenario(choices)); },
              testing::ThrowsMessage<std::invalid_argument>(AllOf(
                  HasSubstr(".yaml:19: draw.routes = (a list), must be starts for random routes: "),
                  HasSubstr("no way leads back to lanelet 15"))));
}

}  // namespace
}  // namespace hlc::scenario::lab_cars_test
