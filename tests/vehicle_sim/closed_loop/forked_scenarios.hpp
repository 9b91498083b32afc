#pragma once

#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

/// Scenarios whose runs are forked in tests, read once.
namespace hlc::closed_loop {

[[nodiscard]] inline const scenario::Scenario& three_cars() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml"});
  return kScenario;
}

/// On the lab's road.
[[nodiscard]] inline const scenario::Scenario& cars_with_right_of_way() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml", .cars = 5});
  return kScenario;
}

}  // namespace hlc::closed_loop
