#pragma once

#include <string>

#include "planner/controller/controller_options.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::scenario {

/// A named set of rules for planning and coordination. A profile is data: planning and coordination
/// do not depend on its name.
struct Profile {
  std::string name;
  road::ReferenceRule reference_rule{road::half_speed_last};
  search::Engine engine{};
  search::CostToGo cost_to_go{};
  controller::ControllerStrategies strategies{};
};

/// |                           | `default`                       | `2022`                       |
/// |---------------------------|---------------------------------|------------------------------|
/// | reference points          | half_speed_last                 | half_speed_last              |
/// | engine                    | branch_and_bound                | best_first                   |
/// | cost-to-go                | admissible: plans are optimal   | the authors', inadmissible   |
/// | coordination              | cooperative                     | agreed: as the authors did   |
/// | - plans come into force   | strict: safe whatever is lost   | if nobody votes against      |
/// | - obstacles               | old and new plans               | predictions, standing cars   |
/// | - priorities mean         | room is made for who is before  | successors plan around       |
/// | incumbent                 | rest of the plan in force       | none: the paper's counts     |
/// | standstill timeout        | once per horizon                | none: the paper's drives     |
///
/// @throws std::invalid_argument for any other name
[[nodiscard]] Profile profile_from_name(const std::string& name);

}  // namespace hlc::scenario
