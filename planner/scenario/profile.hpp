#pragma once

#include <string>

#include "planner/coordination/settle.hpp"
#include "planner/road/reference_points.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// A named set of rules for planning and agreeing. A profile is data: no code asks for its name.
struct Profile {
  std::string name;
  ReferenceRule reference_rule{};
  CostToGo cost_to_go{};
  SettleRule settle_rule{};
};

/// | name | reference points | cost-to-go | new plans come into force |
/// |---|---|---|---|
/// | `default` | first step with the mean of current and reference speed | admissible: every plan
/// is optimal | strict: safe whatever message is lost | | `2022` | last step halved, as when the
/// paper's numbers arose | the authors', inadmissible | agreed: as the authors did |
/// @throws std::invalid_argument for any other name
[[nodiscard]] Profile profile_from_name(const std::string& name);

}  // namespace hlc
