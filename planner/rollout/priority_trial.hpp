#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planner/coordination/joint_gap.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::rollout {

/// What a priority strategy leads to in one rollout.
struct PriorityTrial {
  std::vector<double> step_s;       ///< duration of each step: all vehicles, one after the other
  std::vector<std::size_t> levels;  ///< number of computation levels of each step
  double driven_m{};                ///< by all vehicles' plans
  std::size_t planned{};            ///< new plans that came into force
  std::size_t vehicle_steps{};      ///< of all vehicles
  /// Step in which a vehicle had stood for three horizons for the first time: the authors' measure
  /// of a deadlock. None: no vehicle has.
  std::optional<std::size_t> deadlock_step;
  std::vector<coordination::JointGap> gaps;  ///< of all steps
  /// Sum of the costs of the steps that could be compared: those in which as many vehicles found a
  /// plan as in the optimal order (kOptimalPriorities), from the same situation, and no component
  /// is too large for it.
  double cost_m2{};
  double optimal_order_m2{};  ///< of these steps in the optimal order
  std::size_t compared_steps{};
  std::size_t worse_steps{};  ///< in which fewer vehicles found a plan than in the optimal order
};

/// Steps all vehicles of the scenario with its priorities.
/// @param is_compared  with the optimal order in each step (searched outside of the time measured)
/// @param now_s        a clock [s]
[[nodiscard]] PriorityTrial try_priorities(const scenario::Scenario& scenario, bool is_compared,
                                           const std::function<double()>& now_s);

}  // namespace hlc::rollout
