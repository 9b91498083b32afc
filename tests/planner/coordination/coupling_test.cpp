#include "planner/coordination/coupling.hpp"

#include <gtest/gtest.h>

#include "planner/geometry/footprint.hpp"
#include "tests/planner/coordination/coupling_graph.hpp"

namespace hlc::coordination {
namespace {

Traffic reaching(std::uint8_t vehicle, double x) {
  Traffic traffic;
  traffic.vehicle = {vehicle};
  traffic.reachable_area_m = footprint_area({1.0, 1.0}, {x, 0.0, 0.0});
  return traffic;
}

using Vehicles = std::vector<VehicleId>;

TEST(CouplingGraph, VehiclesWhoseReachMeetsAreCoupledBothWays) {
  const CouplingGraph graph = graph_of({reaching(1, 0.0), reaching(2, 0.9), reaching(3, 5.0)});
  EXPECT_TRUE(graph.are_coupled({1}, {2}));
  EXPECT_TRUE(graph.are_coupled({2}, {1}));
  EXPECT_FALSE(graph.are_coupled({1}, {3}));
  EXPECT_EQ(graph.neighbours({3}), Vehicles{});
}

TEST(CouplingGraph, TheOrderOfMessagesDoesNotMatter) {
  const CouplingGraph one = graph_of({reaching(1, 0.0), reaching(2, 0.9), reaching(3, 1.8)});
  const CouplingGraph other = graph_of({reaching(3, 1.8), reaching(1, 0.0), reaching(2, 0.9)});
  EXPECT_EQ(one.vehicles(), other.vehicles());
  for (std::uint8_t id = 1; id <= 3; ++id) {
    EXPECT_EQ(one.neighbours({id}), other.neighbours({id}));
    EXPECT_EQ(one.component({id}), other.component({id}));
  }
}

TEST(CouplingGraph, AComponentHangsTogetherOverSeveralCouplings) {
  const CouplingGraph graph =
      graph_of({reaching(1, 0.0), reaching(2, 0.9), reaching(3, 1.8), reaching(4, 9.0)});
  EXPECT_FALSE(graph.are_coupled({1}, {3}));
  EXPECT_EQ(graph.component({1}), (Vehicles{{1}, {2}, {3}}));
  EXPECT_EQ(graph.component({4}), Vehicles{{4}});
}

}  // namespace
}  // namespace hlc::coordination
