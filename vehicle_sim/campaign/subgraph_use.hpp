#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::campaign {

/// The subgraphs of a run's plans, by the names in the vehicles' reports.
struct SubgraphUse {
  std::size_t switches{};  ///< steps with another one than the step before, all vehicles
  std::map<std::string, double> shares;  ///< of the steps of all vehicles, by name; their sum is 1
};

/// @param rows  of step_records()
[[nodiscard]] SubgraphUse subgraph_use(std::span<const result::StepRecord> rows);

}  // namespace hlc::campaign
