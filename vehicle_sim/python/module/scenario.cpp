#include "vehicle_sim/python/module/scenario.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <string>
#include <utility>

#include "planner/road/reference_path.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/scenario_assembly.hpp"
#include "planner/scenario/scenario_inputs.hpp"
#include "planner/scenario/scenario_values.hpp"
#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/changed_values.hpp"

namespace hlc::python {
namespace {

LoadedScenario load(const scenario::ScenarioChoices& choices, const py::dict& values) {
  const scenario::ScenarioValues read =
      scenario::parse_scenario(read_with_changes(choices.file, values), choices.file);
  std::string changed_text = values.empty() ? "" : text_with_changes(choices.file, values);
  // Building an automaton solves maneuvers.
  const py::gil_scoped_release release;
  scenario::Scenario scenario =
      scenario::assemble_scenario(read, scenario::load_inputs(read, choices), choices);
  controller::PreparedSubgraph prepared = scenario::prepare_subgraph_of(scenario);
  return {std::move(scenario), std::move(prepared), std::move(changed_text)};
}

py::dict dict_of(const scenario::ScenarioVehicle& vehicle) {
  py::dict dict;
  dict["id"] = vehicle.id.value;
  dict["name"] = vehicle.name;
  dict["start"] = pose_table(std::vector<Pose>{vehicle.start}).attr("reshape")(3);
  dict["route_m"] = point_table(vehicle.path.points_m());
  dict["is_closed"] = vehicle.path.is_closed();
  return dict;
}

py::list vehicles_of(const LoadedScenario& loaded) {
  py::list list;
  for (const scenario::ScenarioVehicle& one : loaded.scenario.vehicles) list.append(dict_of(one));
  return list;
}

py::list obstacles_of(const LoadedScenario& loaded) {
  py::list list;
  for (const scenario::ScenarioObstacle& one : loaded.scenario.obstacles)
    list.append(point_table(one.area_m.vertices_m));
  return list;
}

py::array_t<double> trims_of(const LoadedScenario& loaded) {
  return table(loaded.scenario.subgraph->automaton().trims, 2,
               [](const automaton::Trim& trim, double* numbers) {
                 numbers[0] = trim.speed_mps;
                 numbers[1] = trim.steering_rad;
               });
}

py::tuple size_of(const LoadedScenario& loaded) {
  const Footprint& footprint = loaded.scenario.subgraph->automaton().vehicle.footprint;
  return py::make_tuple(footprint.length_m, footprint.width_m);
}

}  // namespace

void bind_scenario(py::module_& module) {
  using scenario::ScenarioChoices;
  const auto of_scenario = [](auto get) {
    return [get](const LoadedScenario& loaded) { return get(loaded.scenario); };
  };
  using Scenario = scenario::Scenario;
  py::class_<LoadedScenario>(module, "Scenario")
      .def_property_readonly("name", of_scenario([](const Scenario& s) { return s.name; }))
      .def_property_readonly("file", of_scenario([](const Scenario& s) { return s.file; }))
      .def_property_readonly("steps", of_scenario([](const Scenario& s) { return s.steps; }))
      .def_property_readonly("horizon_steps",
                             of_scenario([](const Scenario& s) { return s.horizon_steps; }))
      .def_property_readonly(
          "step_s", of_scenario([](const Scenario& s) { return s.subgraph->automaton().step_s; }))
      .def_property_readonly("reference_speed_mps",
                             of_scenario([](const Scenario& s) { return s.reference_speed_mps; }))
      .def_property_readonly("subgraph",
                             of_scenario([](const Scenario& s) { return s.subgraph->spec().name; }))
      .def_property_readonly("priorities", of_scenario([](const Scenario& s) {
                               return std::string(s.profile.strategies.priorities.strategy->name);
                             }))
      .def_property_readonly(
          "engine", of_scenario([](const Scenario& s) { return scenario::engine_name(s.search); }))
      .def_property_readonly("vehicle_size_m", &size_of)
      .def_property_readonly("trims", &trims_of)
      .def_property_readonly("obstacles_m", &obstacles_of)
      .def_property_readonly("_vehicles", &vehicles_of);
  py::class_<ScenarioChoices>(module, "ScenarioChoices")
      .def(py::init<>())
      .def_readwrite("file", &ScenarioChoices::file)
      .def_readwrite("profile", &ScenarioChoices::profile)
      .def_readwrite("engine", &ScenarioChoices::engine)
      .def_readwrite("priorities", &ScenarioChoices::priorities)
      .def_readwrite("subgraph", &ScenarioChoices::subgraph)
      .def_readwrite("policy", &ScenarioChoices::policy)
      .def_readwrite("map_file", &ScenarioChoices::map_file)
      .def_readwrite("steps", &ScenarioChoices::steps)
      .def_readwrite("cars", &ScenarioChoices::cars)
      .def_readwrite("seed", &ScenarioChoices::seed)
      .def_readwrite("routes", &ScenarioChoices::routes);
  module.def("load_scenario", &load);
}

}  // namespace hlc::python
