// Cars that arrive: at the end of an open route, at the opposite point of a circle, in a goal.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "planner/common/node.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/road/route.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"

namespace hlc::rollout::arrival_test {
namespace {

const std::string kFolder = test::source_folder() + "/launch_scripts/";

scenario::Scenario read(const std::string& name) {
  return scenario::read_scenario({.file = kFolder + "scenarios/" + name + ".yaml"});
}

/// The last report of every car after so many steps.
std::map<VehicleId, coordination::Report> driven(Rollout& rollout, std::size_t steps) {
  std::map<VehicleId, coordination::Report> last;
  for (std::size_t k = 0; k < steps; ++k) {
    std::vector<coordination::Report> reports = rollout.step();
    for (std::size_t i = 0; i < reports.size(); ++i) {
      rollout.controllers()[i]->note_causes(reports[i]);
      if (reports[i].arrived_since) {
        EXPECT_TRUE(reports[i].waiting.vehicles.empty()) << "it waits for nobody";
      }
      last[reports[i].vehicle] = reports[i];
    }
  }
  return last;
}

TEST(Arrival, CarsOnACircleArriveAtTheOppositePointAndStayThere) {
  const scenario::Scenario scenario = read("circle");
  Rollout rollout = make_rollout(scenario);
  const auto first = driven(rollout, 60);
  const auto later = driven(rollout, 40);
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    SCOPED_TRACE(testing::Message() << "vehicle " << int{vehicle.id.value});
    const coordination::Report& report = first.at(vehicle.id);
    ASSERT_TRUE(report.arrived_since);
    EXPECT_GT(report.arrived_since->value, 10U) << "not before it drove";
    EXPECT_EQ(later.at(vehicle.id).arrived_since, report.arrived_since);
    EXPECT_EQ(later.at(vehicle.id).planned_pose, report.planned_pose);
    const Point end_m = vehicle.path.at(vehicle.path.length_m());
    EXPECT_LT((report.planned_pose.position_m() - end_m).norm(), 0.15);
  }
}

/// A car alone on a route of lab_like.
scenario::Scenario alone_on(const std::vector<road::LaneletId>& lanelets, double start_m) {
  scenario::Scenario scenario = read("paper_red_alone");
  const road::LaneletMap map = road::read_lanelet_map(*scenario.map_file);
  const road::Route route = road::build_route(map, lanelets, false);
  scenario::ScenarioVehicle& vehicle = scenario.vehicles.front();
  vehicle.path = route.path;
  vehicle.corridor = route.corridor;
  vehicle.goal.reset();
  scenario.routes = scenario::routes_of(scenario.vehicles);
  return scenario::with_starts(std::move(scenario), std::vector{start_m});
}

std::vector<road::LaneletId> red_circuit() {
  const Node file = Node::read_yaml(kFolder + "scenarios/paper_red_alone.yaml");
  std::vector<road::LaneletId> lanelets;
  const Node route = file.list("routes").front().map("lanelets");
  for (const Node& one : route.list(route.keys().front())) lanelets.push_back(one.as<int>());
  return lanelets;
}

TEST(Arrival, ARouteThatEndsWhereItBeganIsDrivenOnce) {
  const scenario::Scenario scenario = alone_on(red_circuit(), 0.1);
  const scenario::ScenarioVehicle& vehicle = scenario.vehicles.front();
  ASSERT_LT((vehicle.path.at(0.0) - vehicle.path.at(vehicle.path.length_m())).norm(), 0.01);
  Rollout rollout = make_rollout(scenario);
  const auto begin = driven(rollout, 10);
  EXPECT_FALSE(begin.at(vehicle.id).arrived_since) << "its begin is no goal";
  const auto end = driven(rollout, 150);
  ASSERT_TRUE(end.at(vehicle.id).arrived_since);
  EXPECT_GT(end.at(vehicle.id).arrived_since->value, 60U);
  const auto later = driven(rollout, 40);
  EXPECT_EQ(later.at(vehicle.id).planned_pose, end.at(vehicle.id).planned_pose);
}

/// Its path ends in a region so far ahead of its start.
void set_goal(double ahead_m, scenario::ScenarioVehicle& vehicle) {
  const double end_s_m = vehicle.start_s_m + ahead_m;
  const Point middle_m = vehicle.path.at(end_s_m);
  const ConvexPolygon area_m = footprint_area(
      {0.3, 0.2}, {middle_m.x(), middle_m.y(), vehicle.path.heading_rad_at(end_s_m)});
  const road::Stretch stretch =
      road::first_stretch_in(vehicle.path, area_m, vehicle.start_s_m).value();
  vehicle.path = road::path_until(vehicle.path, (stretch.from_s_m + stretch.to_s_m) / 2.0);
  vehicle.goal = road::Goal{.area_m = area_m, .from_s_m = stretch.from_s_m};
}

TEST(Arrival, ACarWithAGoalOnACircuitStandsInItAndStaysThere) {
  const scenario::Scenario three = read("paper_three_cars");
  for (const scenario::ScenarioVehicle& one : three.vehicles) {
    for (const double ahead_m : {2.0, 3.5, one.path.length_m() - 0.4, one.path.length_m()}) {
      SCOPED_TRACE(testing::Message() << one.name << ", goal after " << ahead_m << " m");
      scenario::Scenario scenario = three;
      scenario.vehicles = {one};
      set_goal(ahead_m, scenario.vehicles.front());
      Rollout rollout = make_rollout(scenario);
      const coordination::Report first = driven(rollout, 110).at(one.id);
      EXPECT_TRUE(first.arrived_since);
      EXPECT_TRUE(
          contains(scenario.vehicles.front().goal->area_m, first.planned_pose.position_m()));
      EXPECT_EQ(driven(rollout, 30).at(one.id).planned_pose, first.planned_pose);
    }
  }
}

TEST(Arrival, ACarThatStandsBeforeItsGoalHasNotArrived) {
  scenario::Scenario scenario = read("circle");
  scenario.vehicles.erase(scenario.vehicles.begin() + 1, scenario.vehicles.end());
  scenario.obstacles = {{.name = "wall", .area_m = footprint_area({0.1, 9.0}, {2.25, 2.0, 0.0})}};
  Rollout rollout = make_rollout(scenario);
  EXPECT_FALSE(driven(rollout, 60).begin()->second.arrived_since);
}

}  // namespace
}  // namespace hlc::rollout::arrival_test
