#include "planner/coordination/priority.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planner/geometry/footprint.hpp"
#include "tests/planner/coordination/coupling_graph.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::coordination {
namespace {

const PriorityOrder kSmallerIdFirst;

Traffic reaching(std::uint8_t vehicle, double x, double y) {
  Traffic traffic;
  traffic.vehicle = {vehicle};
  traffic.reachable_area_m = footprint_area({1.0, 1.0}, {x, y, 0.0});
  return traffic;
}

TEST(Priority, TheSmallerIdPlansEarlier) {
  EXPECT_TRUE(kSmallerIdFirst({1}, {2}));
  EXPECT_FALSE(kSmallerIdFirst({2}, {1}));
  EXPECT_FALSE(kSmallerIdFirst({2}, {2}));
}

TEST(Priority, SomeVehiclesMayPlanBeforeAllOthers) {
  std::vector<VehicleId> order{{1}, {2}, {3}, {4}, {5}};
  std::ranges::sort(order, PriorityOrder(std::vector<VehicleId>{{4}, {2}}));
  EXPECT_EQ(order, (std::vector<VehicleId>{{4}, {2}, {1}, {3}, {5}}));
}

TEST(Priority, PredecessorsAreTheCoupledVehiclesThatPlanEarlier) {
  const CouplingGraph graph = graph_of(
      {reaching(1, 0.0, 0.0), reaching(2, 0.5, 0.0), reaching(3, 1.0, 0.5), reaching(4, 9.0, 9.0)});
  EXPECT_EQ(predecessors(graph, {1}, kSmallerIdFirst), std::vector<VehicleId>{});
  EXPECT_EQ(predecessors(graph, {2}, kSmallerIdFirst), std::vector<VehicleId>{{1}});
  EXPECT_EQ(predecessors(graph, {4}, kSmallerIdFirst), std::vector<VehicleId>{});
}

// The directed coupling has no cycle, so no two vehicles wait for each other.
TEST(Priority, EveryPredecessorIsOnALowerLevel) {
  for (unsigned seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.0, 4.0);
    std::vector<Traffic> traffic;
    for (std::uint8_t id = 1; id <= 12; ++id) {
      const double x = place(random);
      traffic.push_back(reaching(id, x, place(random)));
    }
    const CouplingGraph graph = graph_of(traffic);
    const auto levels = computation_levels(graph, kSmallerIdFirst);
    for (const VehicleId vehicle : graph.vehicles()) {
      std::uint32_t expected = 0;
      for (const VehicleId other : predecessors(graph, vehicle, kSmallerIdFirst)) {
        expected = std::max(expected, levels.at(other) + 1);
      }
      EXPECT_EQ(levels.at(vehicle), expected);
    }
  }
}

}  // namespace
}  // namespace hlc::coordination
