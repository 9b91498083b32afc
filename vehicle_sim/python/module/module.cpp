#include "vehicle_sim/python/module/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of the package hlc, which documents it.";
  hlc::python::bind_errors(module);
  hlc::python::bind_scenario(module);
  hlc::python::bind_runs(module);
  hlc::python::bind_automaton(module);
  hlc::python::bind_problem(module);
  hlc::python::bind_pareto(module);
  hlc::python::bind_environments(module);
}
