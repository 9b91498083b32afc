#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/vehicle/single_track.hpp"

namespace hlc::maneuver_design {

/// Derivatives of the states at the interval bounds by all inputs and by the duration.
///
/// Element k is dx_k/d(u_0, ..., u_{N-1}, T), 5 x (2 N + 1): columns 2 i and 2 i + 1 belong to
/// (u_v, u_delta) of interval i, the last one to T. Exact for the Runge-Kutta steps of `shoot`, by
/// propagating the derivative forwards through every stage.
///
/// @pre states are the result of `shoot` for these inputs
[[nodiscard]] std::vector<Eigen::Matrix<double, 5, Eigen::Dynamic>> sensitivities(
    const std::vector<vehicle::State>& states, const std::vector<vehicle::Input>& inputs,
    double duration_s, const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::maneuver_design
