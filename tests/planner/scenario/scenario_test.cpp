#include "planner/scenario/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::scenario_test {
namespace {

const std::string kFolder = test::source_folder() + "/launch_scripts/";

/// Writes a scenario that is valid except for `change`, and returns the error of reading it.
class ScenarioErrors : public testing::Test {
 protected:
  using Changes = std::vector<std::pair<std::string, std::string>>;

  std::string error_of(const std::string& from, const std::string& to) {
    return error_of({{from, to}});
  }
  std::string error_of(const Changes& changes) {
    std::ifstream good(kFolder + "scenarios/paper_three_cars.yaml");
    std::string text((std::istreambuf_iterator<char>(good)), {});
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    for (std::size_t place = 0; (place = text.find("../", place)) != std::string::npos;) {
      text.replace(place, 3, kFolder);
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
};

using testing::HasSubstr;

TEST_F(ScenarioErrors, AnUnknownKeyIsNamedWithItsLine) {
  EXPECT_THAT(error_of("max_exp", "mox_exp"), AllOf(HasSubstr(".yaml:10:"), HasSubstr("mox_exp")));
}

TEST_F(ScenarioErrors, AnUnknownEngineIsNamedWithThoseThereAre) {
  EXPECT_THAT(error_of("horizon_steps: 8", "engine: fast"),
              AllOf(HasSubstr(".yaml:8: engine = fast"),
                    HasSubstr("must be one of branch_and_bound, best_first")));
}

TEST_F(ScenarioErrors, CriterionWeightsAreOfTheAutomatonsCriteriaAndNotNegative) {
  EXPECT_EQ(error_of("horizon_steps: 8", "criterion_weights: {J1: 0.5, J2: 0}"), "");
  EXPECT_THAT(
      error_of("horizon_steps: 8", "criterion_weights: {J9: 0.5}"),
      HasSubstr(".yaml:8: criterion_weights.J9 = 0.5, must be criteria of the automaton's"));
  EXPECT_THAT(error_of("horizon_steps: 8", "criterion_weights: {J2: -0.5}"),
              HasSubstr(".yaml:8: criterion_weights.J2 = -0.5, must be"));
}

TEST_F(ScenarioErrors, AContouringWeightIsNotNegative) {
  EXPECT_EQ(error_of("horizon_steps: 8", "contouring_weight: 150"), "");
  EXPECT_EQ(error_of("horizon_steps: 8", "coordination: strict"), "");
  EXPECT_THAT(
      error_of("horizon_steps: 8", "coordination: polite"),
      HasSubstr(".yaml:8: coordination = polite, must be one of agreed, cooperative, strict"));
  EXPECT_THAT(error_of("horizon_steps: 8", "contouring_weight: -1"),
              HasSubstr(".yaml:8: contouring_weight = -1, must be a number >= 0 and <= 10000"));
  EXPECT_EQ(error_of("horizon_steps: 8", "held_up_contouring_weight: 150"), "");
  EXPECT_THAT(
      error_of("horizon_steps: 8", "held_up_contouring_weight: 10001"),
      HasSubstr(".yaml:8: held_up_contouring_weight = 10001, must be a number >= 0 and <= 10000"));
}

TEST_F(ScenarioErrors, TwoRoundsLeaveNoRoundForVotes) {
  EXPECT_EQ(error_of("horizon_steps: 8", "rounds: two"), "");
  EXPECT_EQ(error_of("horizon_steps: 8", "rounds: sequential"), "");
  EXPECT_THAT(error_of("horizon_steps: 8", "rounds: three"),
              HasSubstr(".yaml:8: rounds = three, must be one of sequential, two"));
  EXPECT_EQ(error_of("horizon_steps: 8", "rounds: sequential\ncoordination: agreed"), "");
  EXPECT_THAT(error_of("horizon_steps: 8", "rounds: two\ncoordination: agreed"),
              HasSubstr(".yaml:8: rounds = two, must be sequential with coordination: agreed"));
}

TEST_F(ScenarioErrors, RightOfWayIsOfClosedRoutesOnly) {
  const std::pair<std::string, std::string> open_route{"closed: true", "closed: false"};
  EXPECT_EQ(error_of("horizon_steps: 8", "right_of_way: true"), "");
  EXPECT_THAT(error_of("horizon_steps: 8", "right_of_way: maybe"),
              HasSubstr(".yaml:8: right_of_way = maybe, must be"));
  EXPECT_THAT(error_of({{"horizon_steps: 8", "right_of_way: true"}, open_route}),
              HasSubstr("scenario.yaml:8: right_of_way = true, must be false: an open route is "
                        "not supported"));
  EXPECT_EQ(error_of({{"horizon_steps: 8", "right_of_way: false"}, open_route}), "");
}

TEST_F(ScenarioErrors, AWrongTypeIsNamedWithWhatIsAllowed) {
  EXPECT_THAT(error_of("steps: 150", "steps: many"), AllOf(HasSubstr("steps"), HasSubstr("many")));
}

TEST_F(ScenarioErrors, AnUnknownLaneletIsNamedWithItsPlace) {
  EXPECT_THAT(error_of("[1, 2, 3, 4, 5,", "[1, 2, 3, 4, 999,"),
              HasSubstr(".yaml:21: routes[1].lanelets.ZAM_LabLike-1_1_T-1[5] = 999, must be"));
}

TEST_F(ScenarioErrors, ARouteThatDoesNotCloseIsNamed) {
  EXPECT_THAT(error_of("7, 8, 9, 10]", "7, 8, 9]"),
              HasSubstr(".yaml:21: routes[1].lanelets.ZAM_LabLike-1_1_T-1 = (a list), must be"));
}

TEST_F(ScenarioErrors, AMapWithoutARouteForItIsNamed) {
  EXPECT_THAT(error_of("ZAM_LabLike-1_1_T-1: [1,", "another_map: [1,"),
              HasSubstr("ZAM_LabLike-1_1_T-1"));
}

TEST_F(ScenarioErrors, StartPosesThatOverlapAreNamed) {
  EXPECT_THAT(error_of("name: blue, route: blue", "name: blue, route: red"),
              AllOf(HasSubstr(".yaml:14: vehicles[2].start_m = 0.0, must be"),
                    HasSubstr("those of vehicles 1 and 2 do")));
}

TEST_F(ScenarioErrors, AnIdBeyondThoseOfAProcessIsRefused) {
  EXPECT_THAT(error_of("id: 2", "id: 256"), AllOf(HasSubstr("256"), HasSubstr("255")));
}

TEST_F(ScenarioErrors, AnIdThatIsTakenTwiceIsRefused) {
  EXPECT_THAT(error_of("id: 2", "id: 1"),
              HasSubstr(".yaml:14: vehicles[2].id = 1, must be unique"));
}

TEST_F(ScenarioErrors, AMissingMapIsNamed) {
  EXPECT_THAT(error_of("lab_like.xml", "nowhere.xml"), HasSubstr("nowhere.xml"));
}

TEST_F(ScenarioErrors, AnUnknownSubgraphNamesThoseThatExist) {
  EXPECT_THAT(error_of("subgraph: B", "subgraph: Z"), AllOf(HasSubstr("Z"), HasSubstr("B")));
}

TEST_F(ScenarioErrors, BrokenYamlIsNamedWithItsFile) {
  EXPECT_THAT(error_of("vehicles:", "vehicles: [}"), HasSubstr(".yaml"));
}

TEST_F(ScenarioErrors, TheUnchangedFileIsGood) {
  EXPECT_EQ(error_of("steps: 150", "steps: 150"), "");
}

TEST(Scenario, AnUnknownProfileIsRefused) {
  EXPECT_THROW(static_cast<void>(profile_from_name("2023")), std::invalid_argument);
}

TEST(Scenario, CarsOnACircleStandApartAndHeadForTheOppositePoint) {
  const ScenarioChoices choices{.file = kFolder + "scenarios/circle.yaml", .cars = 20};
  const Scenario scenario = read_scenario(choices);
  ASSERT_EQ(scenario.vehicles.size(), 20U);
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    const Point centre(2.25, 2.0);
    EXPECT_NEAR((vehicle.start.position_m() - centre).norm(), 1.5, 1e-12);
    EXPECT_NEAR((vehicle.path.at(3.0) - (2.0 * centre - vehicle.start.position_m())).norm(), 0.0,
                1e-9);
    EXPECT_NEAR(wrap_angle(vehicle.path.heading_rad_at(0.0) - vehicle.start.heading_rad), 0.0,
                1e-9);
  }
}

TEST_F(ScenarioErrors, AStartMayBeBesideThePathAndTurned) {
  EXPECT_EQ(error_of("route: green, start_m: 1.5",
                     "route: green, start_m: 1.5, start_left_m: 0.1, start_turned_rad: 0.3"),
            "");
  EXPECT_THAT(error_of("start_m: 1.5", "start_m: 1.5, start_left_m: 11"),
              HasSubstr("start_left_m = 11, must be"));
  EXPECT_THAT(error_of("start_m: 1.5", "start_m: 1.5, start_turned_rad: 4"),
              HasSubstr("start_turned_rad = 4, must be"));
}

/// A controller that sees its vehicle standing there.
std::unique_ptr<controller::Controller> controller_at(const Scenario& scenario, VehicleId id,
                                                      const Pose& measured) {
  std::unique_ptr<controller::Controller> controller = make_controller(scenario, id);
  static_cast<void>(controller->stand_by(
      {.step = {1}, .active = {id}, .states = {{.vehicle = id, .pose = measured}}, .present = {}}));
  return controller;
}

TEST(Scenario, AVehicleTakesItsOwnRouteAndOneThatIsNotNamedTheRouteThatItFits) {
  const Scenario scenario = read_scenario({.file = kFolder + "scenarios/paper_three_cars.yaml"});
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    const Point beside = vehicle.path.at(5.0);
    const Pose pose =
        compose({beside.x(), beside.y(), vehicle.path.heading_rad_at(5.0)}, {0.0, 0.02, 0.1});
    EXPECT_TRUE(controller_at(scenario, vehicle.id, pose)->fits_route());
    const auto guest = controller_at(scenario, {17}, pose);
    EXPECT_TRUE(guest->fits_route());
    EXPECT_LE(
        road::placement_cost_m(*guest->placement()),
        road::placement_cost_m(*controller_at(scenario, vehicle.id, pose)->placement()) + 1e-12);
    EXPECT_EQ(guest->routes().size(), 3U);
  }
  const Pose green = measured_start(scenario, scenario.vehicles[2]);
  EXPECT_EQ(controller_at(scenario, {17}, green)->route().name, "green");
  const auto red = controller_at(scenario, {1}, measured_start(scenario, scenario.vehicles[1]));
  EXPECT_EQ(red->route().name, "red");
}

TEST(Scenario, CarsAreRefusedWhereVehiclesHaveNames) {
  const ScenarioChoices choices{.file = kFolder + "scenarios/paper_red_alone.yaml", .cars = 3};
  EXPECT_THROW(static_cast<void>(read_scenario(choices)), std::invalid_argument);
}

ScenarioChoices three_cars(const std::string& profile, std::optional<std::string> engine = {}) {
  return {.file = kFolder + "scenarios/paper_three_cars.yaml",
          .profile = profile,
          .engine = std::move(engine)};
}

/// That every vehicle's route is in the scenario's conflict map, by its number.
void expect_related(const Scenario& scenario) {
  ASSERT_NE(scenario.conflicts, nullptr);
  const right_of_way::ConflictMap& map = *scenario.conflicts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    ASSERT_LT(vehicle.route_number, map.num_routes());
    EXPECT_EQ(map.length_m(vehicle.route_number), vehicle.path.length_m());
    for (std::size_t cell = 0; cell < map.num_cells(vehicle.route_number); cell += 10) {
      const double s_m = map.cell_m(vehicle.route_number) * static_cast<double>(cell);
      EXPECT_TRUE(contains(map.area_m(vehicle.route_number, cell),
                           vehicle.driving_line.at(vehicle.path, s_m)))
          << vehicle.name << ' ' << s_m;
    }
    const auto controller = make_controller(scenario, vehicle.id);
    EXPECT_EQ(controller->options().conflicts, scenario.conflicts);
    EXPECT_EQ(controller->route().number, vehicle.route_number);
  }
  for (const road::DrivableRoute& route : scenario.routes) {
    EXPECT_EQ(map.length_m(route.number), route.path.length_m());
  }
}

TEST(ScenarioRightOfWay, TheWeightOfAHeldUpVehicleReachesItsController) {
  Scenario scenario = read_scenario({.file = kFolder + "scenarios/lab_cars.yaml", .cars = 1});
  EXPECT_EQ(make_controller(scenario, {1})->options().held_up_contouring_weight, 150.0);
  scenario.held_up_contouring_weight.reset();
  EXPECT_EQ(make_controller(scenario, {1})->options().held_up_contouring_weight, std::nullopt);
}

TEST(ScenarioRightOfWay, EveryRouteIsInTheConflictMapAlsoWhenTheVehiclesAreDrawnAgain) {
  const Scenario scenario = read_scenario({.file = kFolder + "scenarios/lab_cars.yaml", .cars = 5});
  expect_related(scenario);
  // Seven loops, and the routes of five cars that begin elsewhere.
  EXPECT_LE(scenario.conflicts->num_routes(), 12U);
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario drawn = with_random_starts(scenario, seed);
    EXPECT_NE(drawn.conflicts, scenario.conflicts);
    expect_related(drawn);
  }
  expect_related(scenario);
}

TEST(ScenarioRightOfWay, ThereIsNoneUnlessTheScenarioSaysSo) {
  const Scenario scenario = read_scenario({.file = kFolder + "scenarios/paper_three_cars.yaml"});
  EXPECT_EQ(scenario.conflicts, nullptr);
  EXPECT_EQ(make_controller(scenario, {1})->options().conflicts, nullptr);
}

TEST(ScenarioSearch, TheProfileSaysWhatSearchesUnlessTheCommandLineDoes) {
  EXPECT_EQ(read_scenario(three_cars("default")).search.engine, search::Engine::kBranchAndBound);
  EXPECT_EQ(read_scenario(three_cars("default", "best_first")).search.engine,
            search::Engine::kBestFirst);
  const search::SearchOptions through_ompl =
      read_scenario(three_cars("2022", "ompl_best_first")).search;
  EXPECT_EQ(engine_name(through_ompl), "ompl_best_first");
  const Scenario of_2022 = read_scenario(three_cars("2022"));
  EXPECT_EQ(of_2022.search.engine, search::Engine::kBestFirst);
  EXPECT_EQ(of_2022.search.cost_to_go, search::CostToGo::kReferenceSpeed);
}

TEST(ScenarioSearch, TheProfileSaysByWhichRulesControllersPlanAndAgree) {
  const auto strategies = [](const std::string& profile) {
    return make_controller(read_scenario(three_cars(profile)), {1})->options().strategies;
  };
  EXPECT_EQ(strategies("default"), controller::ControllerStrategies{});
  const controller::ControllerStrategies of_2022 = strategies("2022");
  EXPECT_EQ(of_2022.coordination, controller::kAgreedCoordination);
  EXPECT_EQ(read_scenario(three_cars("default")).profile.strategies.coordination,
            controller::kCooperativeCoordination);
  EXPECT_EQ(of_2022.incumbent, &controller::no_incumbent) << "its counts are to be the paper's";
  EXPECT_EQ(of_2022.standstill_timeout, &controller::no_timeout)
      << "its drives are to be the paper's";
}

TEST(ScenarioSearch, AnEngineThatCannotSearchWithTheProfilesCostToGoIsRefused) {
  const auto read = [](const ScenarioChoices& choices) {
    return [choices] { static_cast<void>(read_scenario(choices)); };
  };
  using testing::ThrowsMessage;
  EXPECT_THAT(read(three_cars("2022", "branch_and_bound")),
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("--engine = branch_and_bound with profile 2022, must be best_first")));
  EXPECT_THAT(read(three_cars("default", "fast")),
              ThrowsMessage<std::invalid_argument>(
                  "--engine = fast, must be one of branch_and_bound, best_first, "
                  "ompl_branch_and_bound, ompl_best_first"));
}

}  // namespace
}  // namespace hlc::scenario::scenario_test
