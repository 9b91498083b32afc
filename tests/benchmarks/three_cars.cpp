#include "tests/benchmarks/three_cars.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

/// Smaller ids plan earlier.
constexpr VehicleId kBlue{1};
constexpr VehicleId kGreen{2};
constexpr VehicleId kRed{3};

const std::string kScenarioFile =
    test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml";

void move_to(scenario::ScenarioVehicle& vehicle, VehicleId id, double start_s_m) {
  const Point position_m = vehicle.path.at(start_s_m);
  vehicle.id = id;
  vehicle.start_s_m = start_s_m;
  vehicle.start = {position_m.x(), position_m.y(), vehicle.path.heading_rad_at(start_s_m)};
}

std::unique_ptr<controller::Controller> controller_of(
    const scenario::ScenarioVehicle& vehicle, const scenario::Scenario& scenario,
    const std::shared_ptr<const automaton::Subgraph>& subgraph, Lanes lanes) {
  // Best-first independent of the scenario: a measured engine must not choose its own problems.
  return std::make_unique<controller::Controller>(
      controller::ControllerOptions{.vehicle = vehicle.id,
                                    .horizon_steps = scenario.horizon_steps,
                                    .reference_speed_mps = scenario.reference_speed_mps,
                                    .reference_rule = road::mean_speed_first,
                                    .strategies = {.coordination = controller::kStrictCoordination},
                                    .search = {.engine = search::Engine::kBestFirst}},
      subgraph, vehicle.path, lanes == Lanes::kNone ? road::Corridor{} : vehicle.corridor);
}

}  // namespace

std::vector<road::ReferencePath> three_cars_routes() {
  std::vector<road::ReferencePath> routes;
  for (const scenario::ScenarioVehicle& vehicle :
       scenario::read_scenario({.file = kScenarioFile}).vehicles) {
    routes.push_back(vehicle.path);
  }
  return routes;
}

std::vector<search::HorizonProblem> three_cars_problems(
    const std::shared_ptr<const automaton::Subgraph>& subgraph, Lanes lanes, std::size_t steps,
    const ThreeCarsStart& start) {
  scenario::Scenario scenario = scenario::read_scenario(
      {.file = kScenarioFile}, subgraph->shared_automaton(), {subgraph->spec()});
  for (scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    if (vehicle.name == "red") move_to(vehicle, kRed, 0.0);
    if (vehicle.name == "blue") move_to(vehicle, kBlue, start.blue_m);
    if (vehicle.name == "green") move_to(vehicle, kGreen, start.green_m);
  }
  std::vector<std::unique_ptr<controller::Controller>> controllers;
  std::vector<Pose> starts;
  for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(controller_of(vehicle, scenario, subgraph, lanes));
    starts.push_back(vehicle.start);
  }
  rollout::Rollout rollout(std::move(controllers), starts);
  const controller::Controller& red = *rollout.controllers().back();
  assert(red.options().vehicle == kRed);
  std::vector<search::HorizonProblem> problems;
  for (std::size_t step = 0; step < steps; ++step) {
    static_cast<void>(rollout.step());
    if (!red.problems().empty()) problems.push_back(red.problems().front().problem);
  }
  return problems;
}

}  // namespace hlc::test
