#pragma once

#include <pybind11/pybind11.h>

#include <string>

/// The extension module `hlc._core`: plain functions and classes, whose arrays the Python package
/// `hlc` gives names, shapes, units and documents. One file per subject, each with one function.
namespace hlc::python {

namespace py = pybind11;

/// What a Python function returned, for a message: its repr in one line.
[[nodiscard]] std::string text_of(const py::handle& returned);

/// `Error`, a ValueError: what the planner refuses and what cannot be read, with the same one line
/// as of the programs. @pre the first one
void bind_errors(py::module_& module);
/// `Scenario`, `load_scenario`.
void bind_scenario(py::module_& module);
/// `rollout`, `drive`: whole runs. The interpreter's lock is released meanwhile.
void bind_runs(py::module_& module);
/// `Automaton`, `load_automaton`.
void bind_automaton(py::module_& module);
/// `plan_problem`, `plan_joint_problem`: one planning problem from a file.
void bind_problem(py::module_& module);
/// `pareto_front`, also with criteria that are Python functions.
void bind_pareto(py::module_& module);
/// `Environments`: many small simulations stepped together, for learners.
void bind_environments(py::module_& module);

}  // namespace hlc::python
