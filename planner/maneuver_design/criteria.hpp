#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/maneuver_design/running_cost.hpp"

namespace hlc {

/// Names of all criteria, as they stand in configurations and as labels of maneuvers.
[[nodiscard]] std::vector<std::string> criterion_names();

/// The criterion of that name. @throws std::invalid_argument naming the allowed names
[[nodiscard]] std::unique_ptr<RunningCost> make_criterion(const std::string& name);

}  // namespace hlc
