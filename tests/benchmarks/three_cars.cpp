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

void move_to(ScenarioVehicle& vehicle, VehicleId id, double start_s_m) {
  const Point position_m = vehicle.path.at(start_s_m);
  vehicle.id = id;
  vehicle.start_s_m = start_s_m;
  vehicle.start = {position_m.x(), position_m.y(), vehicle.path.heading_rad_at(start_s_m)};
}

std::unique_ptr<Controller> controller_of(const ScenarioVehicle& vehicle, const Scenario& scenario,
                                          const std::shared_ptr<const Subgraph>& subgraph,
                                          Lanes lanes) {
  // Best-first independent of the scenario: a measured engine must not choose its own problems.
  return std::make_unique<Controller>(
      ControllerOptions{
          .vehicle = vehicle.id,
          .horizon_steps = scenario.horizon_steps,
          .reference_speed_mps = scenario.reference_speed_mps,
          .reference_rule = mean_speed_first,
          .strategies = {.commit = scenario.profile.strategies.commit,
                         .coupled_obstacles = scenario.profile.strategies.coupled_obstacles},
          .search = {.engine = Engine::kBestFirst}},
      subgraph, vehicle.path, lanes == Lanes::kNone ? Corridor{} : vehicle.corridor);
}

}  // namespace

std::vector<ReferencePath> three_cars_routes() {
  std::vector<ReferencePath> routes;
  for (const ScenarioVehicle& vehicle : read_scenario({.file = kScenarioFile}).vehicles) {
    routes.push_back(vehicle.path);
  }
  return routes;
}

std::vector<HorizonProblem> three_cars_problems(const std::shared_ptr<const Subgraph>& subgraph,
                                                Lanes lanes, std::size_t steps,
                                                const ThreeCarsStart& start) {
  Scenario scenario =
      read_scenario({.file = kScenarioFile}, subgraph->shared_automaton(), {subgraph->spec()});
  for (ScenarioVehicle& vehicle : scenario.vehicles) {
    if (vehicle.name == "red") move_to(vehicle, kRed, 0.0);
    if (vehicle.name == "blue") move_to(vehicle, kBlue, start.blue_m);
    if (vehicle.name == "green") move_to(vehicle, kGreen, start.green_m);
  }
  std::vector<std::unique_ptr<Controller>> controllers;
  std::vector<Pose> starts;
  for (const ScenarioVehicle& vehicle : scenario.vehicles) {
    controllers.push_back(controller_of(vehicle, scenario, subgraph, lanes));
    starts.push_back(vehicle.start);
  }
  Rollout rollout(std::move(controllers), starts);
  const Controller& red = *rollout.controllers().back();
  assert(red.options().vehicle == kRed);
  std::vector<HorizonProblem> problems;
  for (std::size_t step = 0; step < steps; ++step) {
    static_cast<void>(rollout.step());
    if (!red.problems().empty()) problems.push_back(red.problems().front());
  }
  return problems;
}

}  // namespace hlc::test
