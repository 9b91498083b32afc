#pragma once

#include <string>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/python/module/bindings.hpp"

namespace hlc::python {

/// A scenario that was read, and its subgraph prepared for all its runs. Never changed: runs in
/// several threads may share it.
struct LoadedScenario {
  scenario::Scenario scenario;
  controller::PreparedSubgraph prepared;
  /// Of its file with the keys that were changed, for the folder of a run; empty: none was.
  std::string changed_text;
};

}  // namespace hlc::python
