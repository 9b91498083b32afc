#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include "planner/automaton/automaton_file.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/scenario/named_subgraph.hpp"
#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {
namespace {

using automaton::AutomatonFile;
using automaton::Maneuver;

/// @param subgraph  of a configuration: builds only what it needs. Absent: all
AutomatonFile load(const std::filesystem::path& path, const std::optional<std::string>& subgraph) {
  if (automaton::is_automaton_file(path)) return maneuver_design::read_current_automaton_file(path);
  maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(path);
  if (subgraph) {
    const automaton::SubgraphSpec* spec =
        scenario::find_subgraph(configuration.subgraphs, *subgraph);
    if (spec == nullptr) {
      throw std::invalid_argument(path.string() + ": subgraph = " + *subgraph +
                                  ", must be one of " +
                                  scenario::names_of(configuration.subgraphs));
    }
    configuration = maneuver_design::needed_by(*spec, std::move(configuration));
  }
  automaton::UniversalAutomaton built = maneuver_design::build_automaton(configuration);
  return maneuver_design::file_of(configuration, std::move(built));
}

py::array_t<double> states_of(const Maneuver& maneuver) {
  return table(maneuver.states, 5, [](const vehicle::State& state, double* numbers) {
    const vehicle::StateVector vector = vehicle::to_vector(state);
    for (Eigen::Index i = 0; i < 5; ++i) numbers[i] = vector(i);
  });
}

py::array_t<double> inputs_of(const Maneuver& maneuver) {
  return table(maneuver.inputs, 2, [](const vehicle::Input& input, double* numbers) {
    numbers[0] = input.acceleration_mps2;
    numbers[1] = input.steering_rate_radps;
  });
}

py::dict dict_of(const Maneuver& maneuver) {
  py::dict dict;
  dict["from_trim"] = maneuver.from.index;
  dict["to_trim"] = maneuver.to.index;
  dict["label"] = maneuver.label;
  dict["duration_s"] = maneuver.duration_s;
  dict["states"] = states_of(maneuver);
  dict["inputs"] = inputs_of(maneuver);
  dict["swept_area_m"] = point_table(maneuver.swept_area_m.vertices_m);
  py::dict criteria;
  for (const CriterionValue& one : maneuver.criteria) criteria[py::str(one.name)] = one.value;
  dict["criteria"] = criteria;
  return dict;
}

py::list maneuvers_of(const AutomatonFile& file) {
  py::list list;
  for (const Maneuver& one : file.automaton->maneuvers) list.append(dict_of(one));
  return list;
}

py::dict subgraphs_of(const AutomatonFile& file) {
  py::dict dict;
  for (const automaton::SubgraphSpec& one : file.subgraphs) dict[py::str(one.name)] = one.labels;
  return dict;
}

}  // namespace

void bind_automaton(py::module_& module) {
  py::class_<AutomatonFile>(module, "AutomatonFile")
      .def_property_readonly("step_s", [](const AutomatonFile& f) { return f.automaton->step_s; })
      .def_property_readonly("trims",
                             [](const AutomatonFile& file) {
                               return table(file.automaton->trims, 2,
                                            [](const automaton::Trim& trim, double* numbers) {
                                              numbers[0] = trim.speed_mps;
                                              numbers[1] = trim.steering_rad;
                                            });
                             })
      .def_property_readonly("maneuvers", &maneuvers_of)
      .def_property_readonly("subgraphs", &subgraphs_of)
      .def("save", &automaton::write_automaton_file, py::call_guard<py::gil_scoped_release>());
  module.def("load_automaton", &load, py::call_guard<py::gil_scoped_release>());
}

}  // namespace hlc::python
