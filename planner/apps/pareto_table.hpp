#pragma once

#include <string>

#include "planner/plot/pareto_data.hpp"

namespace hlc::apps {

/// One row per point, in the order of the front. Columns: the criteria by name, dx [m], dy [m],
/// dpsi [rad] (end pose in the frame of the start), status (optimal or not_converged), duration [s]
/// if it is free, v_max [m/s], dominated and knee (0 or 1), first_order_residual. Numbers with 17
/// digits, so that they read back exactly.
[[nodiscard]] std::string pareto_table(const maneuver_design::ParetoFront& front,
                                       const plot::ParetoDescription& description);

}  // namespace hlc::apps
