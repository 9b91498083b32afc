#include "vehicle_sim/campaign/subgraph_use.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hlc::campaign::subgraph_use_test {
namespace {

result::StepRecord row(std::uint64_t step, std::uint8_t vehicle, const std::string& subgraph) {
  result::StepRecord row{.step = step, .record = {}, .driven = {}};
  row.record.report.vehicle = VehicleId{vehicle};
  row.record.report.subgraph = subgraph;
  return row;
}

TEST(SubgraphUse, CountsEachVehiclesOwnSwitches) {
  const std::vector<result::StepRecord> rows{row(0, 1, "A"), row(0, 2, "B"), row(1, 1, "A"),
                                             row(1, 2, "A"), row(2, 1, "B"), row(2, 2, "A"),
                                             row(3, 1, "A"), row(3, 2, "A")};
  const SubgraphUse use = subgraph_use(rows);
  EXPECT_EQ(use.switches, 3U);
  EXPECT_EQ(use.shares, (std::map<std::string, double>{{"A", 0.75}, {"B", 0.25}}));
}

TEST(SubgraphUse, OfNoStepsIsNothing) {
  EXPECT_EQ(subgraph_use({}).switches, 0U);
  EXPECT_TRUE(subgraph_use({}).shares.empty());
}

}  // namespace
}  // namespace hlc::campaign::subgraph_use_test
