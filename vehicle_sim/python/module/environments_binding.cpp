#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "vehicle_sim/python/module/arrays.hpp"
#include "vehicle_sim/python/module/bindings.hpp"
#include "vehicle_sim/python/module/environments.hpp"
#include "vehicle_sim/python/module/scenario.hpp"

namespace hlc::python {
namespace {

using Actions = py::array_t<std::int64_t, py::array::c_style>;

py::tuple tuple_of(const Environments& environments, const Observed& observed) {
  const std::size_t num = environments.num_environments();
  const std::size_t cars = environments.num_cars();
  const auto flags = [](const std::vector<std::uint8_t>& numbers,
                        const std::vector<std::size_t>& shape) {
    return new_array(shape, numbers.data()).attr("view")("bool");
  };
  return py::make_tuple(
      new_array<float>({num, cars, environments.num_features()}, observed.observations.data()),
      new_array<float>({num, cars}, observed.rewards.data()),
      flags(observed.terminated, {num, cars}), flags(observed.truncated, {num}),
      flags(observed.permitted, {num, cars, environments.num_actions()}),
      new_array<float>({num, cars, environments.num_features()},
                       observed.final_observations.data()));
}

/// A copy: other threads may write the array while the lock is released.
std::vector<std::int64_t> checked(const Environments& environments, const Actions& actions) {
  if (!environments.has_begun())
    throw std::invalid_argument("step: no episode has begun, reset must be called first");
  const auto num = static_cast<py::ssize_t>(environments.num_environments());
  const auto cars = static_cast<py::ssize_t>(environments.num_cars());
  if (actions.ndim() != 2 || actions.shape(0) != num || actions.shape(1) != cars) {
    throw std::invalid_argument(fmt::format("actions: must be of the shape ({}, {})", num, cars));
  }
  const auto most = static_cast<std::int64_t>(environments.num_actions());
  std::vector<std::int64_t> all(actions.data(), actions.data() + actions.size());
  for (const std::int64_t one : all) {
    if (one < 0 || one >= most)
      throw std::invalid_argument(fmt::format("actions: {}, must be 0 ... {}", one, most - 1));
  }
  return all;
}

py::tuple reset(Environments& environments, std::uint64_t seed) {
  Observed observed;
  {
    const py::gil_scoped_release release;
    environments.reset(seed, observed);
  }
  return tuple_of(environments, observed);
}

py::tuple step(Environments& environments, const Actions& actions) {
  const std::vector<std::int64_t> all = checked(environments, actions);
  Observed observed;
  {
    const py::gil_scoped_release release;
    environments.step(all, observed);
  }
  return tuple_of(environments, observed);
}

py::object poses(const Environments& environments) {
  return pose_table(environments.poses())
      .attr("reshape")(environments.num_environments(), environments.num_cars(), 3);
}

std::unique_ptr<Environments> make(const LoadedScenario& loaded, std::size_t num_environments,
                                   std::size_t episode_steps, bool has_random_starts) {
  return std::make_unique<Environments>(loaded.scenario,
                                        EnvironmentOptions{.num_environments = num_environments,
                                                           .episode_steps = episode_steps,
                                                           .has_random_starts = has_random_starts});
}

}  // namespace

void bind_environments(py::module_& module) {
  py::class_<Environments>(module, "Environments")
      .def(py::init(&make))
      .def_property_readonly("num_environments", &Environments::num_environments)
      .def_property_readonly("num_cars", &Environments::num_cars)
      .def_property_readonly("num_actions", &Environments::num_actions)
      .def_property_readonly("num_features", &Environments::num_features)
      .def_property_readonly("poses", &poses)
      .def("reset", &reset)
      .def("step", &step);
}

}  // namespace hlc::python
