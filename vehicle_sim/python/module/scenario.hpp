#pragma once

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {

/// A scenario that was read, and its subgraph prepared for all its runs. Never changed: runs in
/// several threads may share it.
struct LoadedScenario {
  scenario::Scenario scenario;
  controller::PreparedSubgraph prepared;
};

}  // namespace hlc::python
