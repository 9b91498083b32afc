#pragma once

#include <cstdint>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "planner/controller/control_loop.hpp"
#include "planner/policy/subgraph_selector.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc::closed_loop {

/// A vehicle of an experiment with its controller.
struct Member {
  std::uint8_t id;
  simulated_vehicle::SimulatedVehicle vehicle;
  high_level_controller::HlcCore hlc;
  controller::ControlLoop loop;  ///< over the controller of `hlc`
  policy::SubgraphSelector choice;
  bool is_stop_requested{};
  bool has_left{};
};

}  // namespace hlc::closed_loop
