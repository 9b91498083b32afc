#include "vehicle_sim/campaign/subgraph_use.hpp"

namespace hlc::campaign {

SubgraphUse subgraph_use(std::span<const result::StepRecord> rows) {
  SubgraphUse use;
  std::map<VehicleId, std::string> last;
  for (const result::StepRecord& row : rows) {
    const coordination::Report& report = row.record.report;
    const auto [before, is_first] = last.try_emplace(report.vehicle, report.subgraph);
    if (!is_first && before->second != report.subgraph) ++use.switches;
    before->second = report.subgraph;
    use.shares[report.subgraph] += 1.0;
  }
  for (auto& [name, share] : use.shares) share /= static_cast<double>(rows.size());
  return use;
}

}  // namespace hlc::campaign
