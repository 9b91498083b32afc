#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planner/controller/controller.hpp"

namespace hlc::policy {

struct LookAheadRolloutSettings {
  std::size_t steps{8};
  std::vector<search::PlanningWeight> criterion_weights;
  std::size_t max_expansions{};   ///< of each search
  std::size_t most_expansions{};  ///< of all searches together: a step may need several
};

/// Called before each step of a look-ahead rollout with the stepped controller, which it may
/// switch.
using BeforeStep = std::function<void(controller::Controller&)>;

/// Simulates the vehicle over the next steps in a closed loop: the controller is stepped as usual,
/// its vehicle follows the plan exactly, and the other vehicles drive the plans announced in the
/// last step (Controller::announced_plans), and then stand, as every controller assumes. Vehicles
/// that published nothing are absent.
///
/// The cost of a step is the planning cost of the driven motion:
///
///     c_k = |p(k+2) - r_k|^2 + sum_c w_c c(e_k)   [m^2]
///
/// with p(k+2) the planned position at t(k+2), r_k the point of the path at the arc length of
/// p(k+1) plus speed * step, at the reference speed or that of the slowest section of the route on
/// this way, e_k the maneuver between the two, and w_c its weights.
///
/// @param controller  after a step; it is not changed
/// @return sum of c_k over the steps; none for a controller without a plan or a place on its path,
/// or if most_expansions do not suffice: the rollout ends with the step that exceeds them
[[nodiscard]] std::optional<double> rollout_cost_m2(const controller::Controller& controller,
                                                    const LookAheadRolloutSettings& settings,
                                                    const BeforeStep& before_step);

}  // namespace hlc::policy
