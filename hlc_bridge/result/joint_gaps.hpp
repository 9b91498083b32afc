#pragma once

#include <map>
#include <span>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/coordination/joint_gap.hpp"

namespace hlc::result {

/// coordination::joint_gaps of every step in which there are any. @param rows  by step
[[nodiscard]] std::map<std::uint64_t, std::vector<coordination::JointGap>> joint_gaps_by_step(
    std::span<const StepRecord> rows);

}  // namespace hlc::result
