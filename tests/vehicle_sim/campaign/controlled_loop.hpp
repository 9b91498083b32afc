#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "planner/controller/controller.hpp"
#include "vehicle_sim/campaign/simulated_vehicle.hpp"

/// A controller and a simulated vehicle in one loop: states 60 ms old in, commands out.
namespace hlc::controlled_loop {

/// How far one vehicle strayed from what its controller planned and told the others.
struct Stray {
  double deviation_m{};          ///< largest footprint_deviation_m at any tick
  double position_m{};           ///< largest distance of positions
  double yaw_rad{};              ///< largest difference of yaws, planned one mapped
  double outside_m{};            ///< farthest that the footprint stuck out of the areas told
  std::uint64_t outside_tick{};  ///< when that was
  double beyond_reach_m{};  ///< farthest that a prediction stuck out of the reachable area told
  std::size_t steps_at_limit{};  ///< steps begun or ended in a trim at the steering limit
  std::size_t fallback_steps{};
  std::size_t astray_steps{};  ///< of these, with the vehicle off its plan
};

/// Drives `steps` control steps from step 5 on. The vehicle starts where `start` plans it to stand.
/// @param gives_up  steps in which the controller is not let plan
[[nodiscard]] Stray drive(Controller& controller, const Pose& start, std::size_t steps,
                          std::optional<std::uint64_t> noise_seed,
                          const std::function<bool(std::uint64_t step)>& gives_up);

}  // namespace hlc::controlled_loop
