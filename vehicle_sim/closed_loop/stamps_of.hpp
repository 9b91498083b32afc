#pragma once

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::closed_loop {

/// Those of the vehicles that a scenario is for.
[[nodiscard]] inline simulated_vehicle::Stamps stamps_of(const scenario::Scenario& scenario) {
  return scenario::has_early_stamps(scenario) ? simulated_vehicle::Stamps::kLab
                                              : simulated_vehicle::Stamps::kExact;
}

}  // namespace hlc::closed_loop
