#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc::maneuver_design {

/// Names of all criteria, as they stand in configurations and as labels of maneuvers:
///
/// | name              | file                  | running cost                           |
/// |-------------------|-----------------------|----------------------------------------|
/// | J1                | distance.hpp          | -(s_x^2 + s_y^2)                       |
/// | J2                | effort.hpp            | u_v^2 + u_delta^2                      |
/// | J3                | weighted_sum.hpp      | 0.5 J1 + 0.5 J2                        |
/// | comfort           | comfort.hpp           | u_v^2 + (v psi')^2 + u_delta^2         |
/// | energy            | energy.hpp            | max(u_v, 0) v                          |
/// | stopping_distance | stopping_distance.hpp | s_x^2 + s_y^2, for maneuvers to a stop |
/// | travel_time       | travel_time.hpp       | 1, for maneuvers of free duration      |
[[nodiscard]] std::vector<std::string> criterion_names();

/// The criterion of that name, for that vehicle.
/// @throws std::invalid_argument naming the known names
[[nodiscard]] std::unique_ptr<RunningCost> make_criterion(
    const std::string& name, const vehicle::VehicleParameters& vehicle);

}  // namespace hlc::maneuver_design
