#include "hlc_bridge/result/joint_gaps.hpp"

#include <utility>

namespace hlc::result {

std::map<std::uint64_t, std::vector<coordination::JointGap>> joint_gaps_by_step(
    std::span<const StepRecord> rows) {
  std::map<std::uint64_t, std::vector<coordination::JointGap>> by_step;
  for (std::size_t i = 0; i < rows.size();) {
    const std::uint64_t step = rows[i].step;
    std::vector<const coordination::Report*> reports;
    for (; i < rows.size() && rows[i].step == step; ++i) reports.push_back(&rows[i].record.report);
    std::vector<coordination::JointGap> gaps = coordination::joint_gaps(reports);
    if (!gaps.empty()) by_step[step] = std::move(gaps);
  }
  return by_step;
}

}  // namespace hlc::result
