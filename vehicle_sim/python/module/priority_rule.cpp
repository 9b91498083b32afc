#include "vehicle_sim/python/module/priority_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/record/configuration.hpp"
#include "planner/common/demand.hpp"
#include "vehicle_sim/python/module/arrays.hpp"

namespace hlc::python {
namespace {

using coordination::PrioritySituation;
using coordination::Traffic;

thread_local const py::object* rule_in_force = nullptr;

py::object answer_to(const PrioritySituation& situation) {
  py::list coupled;
  for (const VehicleId vehicle : situation.graph.vehicles()) {
    py::list others;
    for (const VehicleId other : situation.graph.neighbours(vehicle)) others.append(other.value);
    coupled.append(std::move(others));
  }
  std::vector<Pose> poses;
  for (const Traffic* one : situation.traffic) poses.push_back(one->next_pose);
  return (*rule_in_force)(
      column<std::int64_t>(situation.traffic,
                           [](const Traffic* one) { return one->vehicle.value; }),
      std::move(coupled), pose_table(poses),
      column<std::int64_t>(situation.traffic,
                           [](const Traffic* one) { return one->next_trim.index; }),
      column<std::int64_t>(situation.traffic,
                           [](const Traffic* one) { return one->standing_steps; }));
}

[[noreturn]] void refuse(const py::handle& answer, const PrioritySituation& situation) {
  std::vector<unsigned> known;
  for (const VehicleId vehicle : situation.graph.vehicles()) known.push_back(vehicle.value);
  throw std::invalid_argument(
      fmt::format("priorities: the function returned {}, must be a sequence of some of the "
                  "vehicles {}, none twice",
                  text_of(answer), fmt::join(known, ", ")));
}

std::vector<VehicleId> order_of(const PrioritySituation& situation) {
  const py::gil_scoped_acquire acquire;
  HLC_DEMAND(rule_in_force != nullptr);
  const py::object answer = answer_to(situation);
  if (py::isinstance<py::str>(answer) || !py::isinstance<py::iterable>(answer)) {
    refuse(answer, situation);
  }
  const std::vector<VehicleId>& known = situation.graph.vehicles();
  std::vector<VehicleId> order;
  for (const py::handle& one : answer) {
    if (PyIndex_Check(one.ptr()) == 0) refuse(answer, situation);
    // A number beyond the range, which is no vehicle either, becomes the nearest one in it.
    const Py_ssize_t id = PyNumber_AsSsize_t(one.ptr(), nullptr);
    if (id == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    const auto found = std::ranges::find(known, id, [](VehicleId it) { return it.value; });
    if (found == known.end() || std::ranges::find(order, *found) != order.end()) {
      refuse(answer, situation);
    }
    order.push_back(*found);
  }
  return order;
}

}  // namespace

constinit const coordination::PriorityStrategy kPythonPriorities{
    .name = record::kRuleInPython,
    .meaning = "in the order of a Python function",
    .assign = &order_of};

PriorityRuleInForce::PriorityRuleInForce(const py::object& rule) : before_(rule_in_force) {
  rule_in_force = rule.is_none() ? nullptr : &rule;
}

PriorityRuleInForce::~PriorityRuleInForce() { rule_in_force = before_; }

}  // namespace hlc::python
