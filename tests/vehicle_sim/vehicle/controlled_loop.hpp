#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "planner/scenario/scenario.hpp"

/// How far a vehicle strays from its plan in a whole run (vehicle_sim/closed_loop/experiment.hpp).
namespace hlc::simulated_vehicle::controlled_loop {

/// Deviation of one vehicle from its controller's plan and announced areas.
struct Stray {
  double deviation_m{};          ///< largest footprint_deviation_m at any tick
  double outside_m{};            ///< farthest that the footprint stuck out of the announced areas
  std::uint64_t outside_tick{};  ///< when that was
  /// Farthest that a prediction stuck out of the announced reachable area
  double beyond_reach_m{};
  std::size_t steps_at_limit{};  ///< steps begun or ended in a trim at the steering limit
  std::size_t fallback_steps{};
};

/// Drives all steps of a scenario with one vehicle.
/// @param is_late  asked once per step: the controller is not let plan
[[nodiscard]] Stray drive(const scenario::Scenario& scenario,
                          std::optional<std::uint64_t> noise_seed,
                          const std::function<bool()>& is_late);

}  // namespace hlc::simulated_vehicle::controlled_loop
