#include <exception>
#include <stdexcept>
#include <string>

#include "planner/common/yaml_text.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {
namespace {

/// Exceptions of Python functions that were called do not come here: they pass unchanged.
void translate(const std::exception_ptr& thrown, PyObject* error) {
  try {
    std::rethrow_exception(thrown);
  } catch (const py::builtin_exception&) {
    throw;  // of the bindings themselves, such as a TypeError
  } catch (const std::invalid_argument& refused) {
    PyErr_SetString(error, refused.what());
  } catch (const std::runtime_error& failed) {
    PyErr_SetString(error, failed.what());
  }
}

}  // namespace

std::string text_of(const py::handle& returned) {
  return one_line(py::cast<std::string>(py::repr(returned)));
}

void bind_errors(py::module_& module) {
  // The translator is a function without state; the module owns the class and is never unloaded.
  static PyObject* error =
      py::exception<std::invalid_argument>(module, "Error", PyExc_ValueError).release().ptr();
  py::register_exception_translator([](std::exception_ptr thrown) {  // NOLINT: pybind11's type
    if (thrown) translate(thrown, error);
  });
}

}  // namespace hlc::python
