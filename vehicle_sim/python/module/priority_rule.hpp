#pragma once

#include "planner/coordination/priority.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {

/// The strategy `python`: the order that the Python function of this thread's run returns.
///
/// The function is called in every step with what all controllers know alike (PrioritySituation):
/// the vehicles' ids, for each of them the list of those that it is coupled with, their poses and
/// trims at the begin of the new plan, and for how many steps they have stood. It returns ids in
/// the order in which they plan; those that it leaves out follow, smaller ids first. Its own
/// exceptions end the run, unchanged.
/// @throws std::invalid_argument from the run if it returns an id twice, one that is not there, or
/// something else
extern const coordination::PriorityStrategy kPythonPriorities;

/// Makes a Python function the rule of the runs of this thread, until its end. A strategy is a
/// plain function without an object of its own, and a run stays in one thread.
class PriorityRuleInForce {
 public:
  /// @param rule  None: the strategy `python` must not be used
  explicit PriorityRuleInForce(const py::object& rule);
  ~PriorityRuleInForce();
  PriorityRuleInForce(const PriorityRuleInForce&) = delete;
  PriorityRuleInForce& operator=(const PriorityRuleInForce&) = delete;

 private:
  const py::object* before_;  ///< of a run whose rule has begun this one
};

}  // namespace hlc::python
