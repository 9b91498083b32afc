#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/pareto_front.hpp"
#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {
namespace {

using maneuver_design::ParetoFront;
using maneuver_design::ParetoPoint;
using maneuver_design::ParetoProblem;
using Trim = std::array<double, 2>;

/// The first exception of a problem's Python functions. The solver takes exceptions for numerical
/// trouble and tries other starts: all calls fail then, and the caller throws this one.
struct Failure {
  std::exception_ptr first;

  template <class Call>
  auto guarded(Call call) {
    if (first) std::rethrow_exception(first);
    try {
      return call();
    } catch (...) {
      first = std::current_exception();
      throw;
    }
  }
};

/// A running cost by Python functions of state (5,) and input (2,); see hlc.Cost.
class PythonCost : public maneuver_design::RunningCost {
 public:
  /// @param cost     value: (x, u) -> l; gradient: (x, u) -> (dl/dx of 5 numbers, dl/du of 2)
  /// @param failure  outlives this object
  PythonCost(const py::object& cost, Failure& failure)
      : value_(cost.attr("value")),
        gradient_(cost.attr("gradient")),
        depends_on_pose_(py::cast<bool>(cost.attr("depends_on_pose"))),
        failure_(&failure) {}

  [[nodiscard]] double value(const vehicle::StateVector& x,
                             const vehicle::Input& u) const override {
    return failure_->guarded([&] {
      const py::gil_scoped_acquire acquire;
      const py::object value = called(value_, x, u);
      const double number = PyFloat_AsDouble(value.ptr());
      if (number == -1.0 && PyErr_Occurred() != nullptr) refuse_value(value);
      return finite(number, "value");
    });
  }

  [[nodiscard]] maneuver_design::CostGradient gradient(const vehicle::StateVector& x,
                                                       const vehicle::Input& u) const override {
    return failure_->guarded([&] { return called_gradient(x, u); });
  }

  [[nodiscard]] bool depends_on_pose() const override { return depends_on_pose_; }

 private:
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

  [[nodiscard]] maneuver_design::CostGradient called_gradient(const vehicle::StateVector& x,
                                                              const vehicle::Input& u) const {
    const py::gil_scoped_acquire acquire;
    const py::object both = called(gradient_, x, u);
    if (!py::isinstance<py::sequence>(both) || py::len(both) != 2) refuse_gradient(both);
    const Numbers by_state = Numbers::ensure(both[py::int_(0)]);
    const Numbers by_input = Numbers::ensure(both[py::int_(1)]);
    if (!by_state || !by_input || by_state.size() != 5 || by_input.size() != 2)
      refuse_gradient(both);
    maneuver_design::CostGradient result;
    for (py::ssize_t i = 0; i < 5; ++i) result.state(i) = finite(by_state.data()[i], "gradient");
    for (py::ssize_t i = 0; i < 2; ++i) result.input(i) = finite(by_input.data()[i], "gradient");
    return result;
  }
  static py::object called(const py::object& function, const vehicle::StateVector& x,
                           const vehicle::Input& u) {
    const std::array<double, 2> input{u.acceleration_mps2, u.steering_rate_radps};
    return function(new_array<double>({5}, x.data()), new_array<double>({2}, input.data()));
  }
  static double finite(double number, const char* of) {
    if (std::isfinite(number)) return number;
    throw std::invalid_argument(
        fmt::format("criteria: the {} of a Cost is {}, must be finite", of, number));
  }
  /// The pending exception, of a conversion, is dropped. @pre there is one
  [[noreturn]] static void refuse_value(const py::object& returned) {
    PyErr_Clear();
    throw std::invalid_argument(
        fmt::format("criteria: the value of a Cost is {}, must be a number", text_of(returned)));
  }
  [[noreturn]] static void refuse_gradient(const py::object& returned) {
    throw std::invalid_argument(
        fmt::format("criteria: the gradient of a Cost is {}, must be two arrays, of 5 numbers "
                    "(dl/dx) and 2 (dl/du)",
                    text_of(returned)));
  }

  py::object value_;
  py::object gradient_;
  bool depends_on_pose_;
  Failure* failure_;
};

std::shared_ptr<const maneuver_design::RunningCost> cost_of(
    const py::object& criterion, const vehicle::VehicleParameters& vehicle, Failure& failure) {
  if (py::isinstance<py::str>(criterion)) {
    return maneuver_design::make_criterion(py::cast<std::string>(criterion), vehicle);
  }
  return std::make_shared<const PythonCost>(criterion, failure);
}

void check_trim(const char* name, const Trim& trim, const vehicle::VehicleLimits& limits) {
  if (trim[0] >= limits.speed_min_mps && trim[0] <= limits.speed_max_mps &&
      std::abs(trim[1]) <= limits.steering_max_rad) {
    return;
  }
  throw std::invalid_argument(
      fmt::format("{} = ({}, {}), must be in {} ... {} m/s and -{} ... {} rad", name, trim[0],
                  trim[1], limits.speed_min_mps, limits.speed_max_mps, limits.steering_max_rad,
                  limits.steering_max_rad));
}

ParetoProblem problem_of(const std::filesystem::path& configuration, const Trim& from,
                         const Trim& to, const py::list& criteria, std::optional<double> duration_s,
                         Failure& failure) {
  const maneuver_design::AutomatonConfiguration c =
      maneuver_design::read_automaton_configuration(configuration);
  check_trim("from_trim", from, c.limits);
  check_trim("to_trim", to, c.limits);
  ParetoProblem problem;
  problem.maneuver = maneuver_design::problem_between({from[0], from[1]}, {to[0], to[1]}, c);
  if (duration_s) problem.maneuver.duration_s = *duration_s;
  for (const py::handle& one : criteria) {
    problem.criteria.push_back(
        cost_of(py::reinterpret_borrow<py::object>(one), c.vehicle, failure));
  }
  return problem;
}

py::dict dict_of(const ParetoFront& front, std::size_t num_criteria) {
  py::dict dict;
  dict["objectives"] =
      table(front.points, num_criteria, [](const ParetoPoint& point, double* numbers) {
        for (const double value : point.objectives) *numbers++ = value;
      });
  dict["is_dominated"] =
      column<bool>(front.points, [](const ParetoPoint& point) { return point.is_dominated; });
  std::vector<Pose> ends;
  for (const ParetoPoint& one : front.points) ends.push_back(one.solution.states.back().pose);
  dict["end"] = pose_table(ends);
  dict["knee"] = maneuver_design::knee_point(front.objectives());
  return dict;
}

ParetoFront solved(const ParetoProblem& problem, std::size_t points, Failure& failure) {
  const py::gil_scoped_release release;
  maneuver_design::ParetoOptions options{.points = points};
  options.progress = [](std::size_t /*done*/, std::size_t /*of*/) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  ParetoFront front;
  try {
    front = maneuver_design::epsilon_constraint_front(problem, options);
  } catch (const std::exception&) {
    if (!failure.first) throw;
  }
  if (failure.first) std::rethrow_exception(failure.first);
  return front;
}

py::dict pareto_front(const std::filesystem::path& configuration, const Trim& from, const Trim& to,
                      const py::list& criteria, std::size_t points,
                      std::optional<double> duration_s) {
  Failure failure;
  const ParetoProblem problem = problem_of(configuration, from, to, criteria, duration_s, failure);
  ParetoFront front = solved(problem, points, failure);
  if (front.status != maneuver_design::ManeuverStatus::kOptimal) {
    throw std::runtime_error(configuration.string() + ": " + front.reason);
  }
  return dict_of(front, problem.criteria.size());
}

}  // namespace

void bind_pareto(py::module_& module) {
  module.def("pareto_front", &pareto_front);
  module.attr("criteria") = maneuver_design::criterion_names();
}

}  // namespace hlc::python
