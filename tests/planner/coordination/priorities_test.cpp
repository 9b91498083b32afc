#include "planner/coordination/priorities/strategies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>

#include "planner/common/random_index.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/planner/coordination/coupling_graph.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::coordination::priorities_test {
namespace {

using testing::ElementsAre;
using testing::IsSubsetOf;
using testing::UnorderedElementsAreArray;

using Order = std::vector<VehicleId>;

ConvexPolygon square(double x_m, double y_m, double side_m = 1.0) {
  return footprint_area({side_m, side_m}, {x_m, y_m, 0.0});
}

/// Traffic with its graph.
struct Situation {
  explicit Situation(std::vector<Traffic> of) : traffic(std::move(of)), graph(graph_of(traffic)) {
    for (const Traffic& one : traffic) pointers.push_back(&one);
  }
  [[nodiscard]] PrioritySituation get() const { return {.graph = graph, .traffic = pointers}; }

  std::vector<Traffic> traffic;
  CouplingGraph graph;
  std::vector<const Traffic*> pointers;
};

/// Vehicles 1 to `cars` at random places, with references of their own.
Situation drawn(std::mt19937_64& random, std::size_t cars, double road_m = 4.0) {
  std::uniform_real_distribution<double> place(0.0, road_m);
  std::vector<Traffic> traffic;
  for (std::size_t i = 0; i < cars; ++i) {
    const double x_m = place(random);
    const double y_m = place(random);
    traffic.push_back({.vehicle = {static_cast<std::uint8_t>(i + 1)},
                       .step = {random_index(random, 1000)},
                       .next_pose = {x_m, y_m, 0.0},
                       .reachable_area_m = square(x_m, y_m),
                       .standing_steps = static_cast<std::uint32_t>(random_index(random, 3)),
                       .reference_areas_m = {square(x_m, y_m, 0.3), square(y_m, x_m, 0.3)}});
  }
  return Situation(std::move(traffic));
}

/// Costs of plans that depend on nothing but who of each coupled pair plans first. An order that is
/// not better than the one to beat ends without any plan, as TryOrder may end it.
class MadeUpCosts {
 public:
  MadeUpCosts(const CouplingGraph& graph, std::uint64_t seed) : graph_(&graph), seed_(seed) {}

  OrderCost operator()(const Order& order, const OrderCost* to_beat = nullptr) {
    ++num_tried_;
    OrderCost cost;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double own_m2 = cost_m2(order, i);
      const bool has_plan = own_m2 < kWithoutPlan_m2;
      if (!has_plan) ++cost.without_plan;
      cost.cost_m2 += has_plan ? own_m2 : 0.0;
      cost.costs_m2.push_back(has_plan ? own_m2 : std::numeric_limits<double>::infinity());
    }
    cost.expanded = 50 * order.size();
    expanded_ += cost.expanded;
    if (to_beat != nullptr && !is_better(cost, *to_beat)) {
      cost.without_plan = order.size();
      cost.cost_m2 = 0.0;
      std::ranges::fill(cost.costs_m2, std::numeric_limits<double>::infinity());
    }
    return cost;
  }

  [[nodiscard]] std::size_t num_tried() const { return num_tried_; }
  [[nodiscard]] std::size_t expanded() const { return expanded_; }

 private:
  static constexpr double kWithoutPlan_m2 = 2000.0;

  [[nodiscard]] double cost_m2(const Order& order, std::size_t i) const {
    double sum_m2 = 0.0;
    for (std::size_t j = 0; j < i; ++j) {
      if (!graph_->are_coupled(order[j], order[i])) continue;
      std::mt19937_64 random(seed_ + std::uint64_t{1000} * order[j].value + order[i].value);
      sum_m2 += static_cast<double>(random_index(random, 1000));  // whole: sums are exact
    }
    return sum_m2;
  }

  const CouplingGraph* graph_;
  std::uint64_t seed_;
  std::size_t num_tried_{};
  std::size_t expanded_{};
};

class EachStrategy : public testing::TestWithParam<const PriorityStrategy*> {};

TEST_P(EachStrategy, NamesNoVehicleTwiceAndNoOtherOne) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 1 + random_index(random, 12));
    const Order order = GetParam()->assign(situation.get());
    EXPECT_EQ(std::set(order.begin(), order.end()).size(), order.size());
    EXPECT_THAT(order, IsSubsetOf(situation.graph.vehicles()));
  }
}

// So who is first in one order is so in all of them.
TEST_P(EachStrategy, LeavesThoseFirstThatTheRuleNames) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 6);
    const PriorityRule rule{
        .strategy = GetParam(), .first = {{4}, {9}, {2}}, .max_levels = random_index(random, 4)};
    Order order = situation.graph.vehicles();
    std::ranges::sort(order, rule.assign(situation.get()));
    EXPECT_EQ(order[0], VehicleId{4});
    EXPECT_EQ(order[1], VehicleId{2});
  }
}

class EachSearch : public EachStrategy {};

TEST_P(EachSearch, FindsNoWorseOrderThanItBeginsWithAndKeepsToItsBudget) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const std::size_t most = GetParam()->most_vehicles != 0 ? GetParam()->most_vehicles : 12;
    const Situation situation = drawn(random, 1 + random_index(random, most), 2.0);
    const Order start = situation.graph.component({1});
    MadeUpCosts costs(situation.graph, seed);
    const Order found = GetParam()->search(situation.graph, start, std::ref(costs));
    EXPECT_THAT(found, UnorderedElementsAreArray(start));
    if (GetParam()->most_vehicles == 0) {
      EXPECT_LT(costs.expanded(), kMostOrderExpansions + 50 * start.size());
    }
    EXPECT_FALSE(is_better(costs(start), costs(found)));
    MadeUpCosts again(situation.graph, seed);
    EXPECT_EQ(GetParam()->search(situation.graph, start, std::ref(again)), found);
  }
}

INSTANTIATE_TEST_SUITE_P(Priorities, EachStrategy,
                         testing::ValuesIn(priority_strategies().begin(),
                                           priority_strategies().end()),
                         [](const auto& tested) { return std::string(tested.param->name); });

INSTANTIATE_TEST_SUITE_P(Priorities, EachSearch,
                         testing::Values(&kExplorativePriorities, &kOptimalPriorities, &kBestOrder),
                         [](const auto& tested) { return std::string(tested.param->name); });

TEST(OptimalPriorities, AreTheCheapestOfAllOrdersAndTryNoneTwice) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 5, 2.0);
    Order order = situation.graph.component({1});
    MadeUpCosts costs(situation.graph, seed);
    const OrderCost found = MadeUpCosts(
        situation.graph, seed)(kOptimalPriorities.search(situation.graph, order, std::ref(costs)));
    MadeUpCosts all(situation.graph, seed);
    do {
      EXPECT_FALSE(is_better(all(order), found));
    } while (std::ranges::next_permutation(order).found);
    EXPECT_LE(costs.num_tried(), all.num_tried());
  }
}

// Without couplings every order leads to the same plans.
TEST(OptimalPriorities, TryOneOrderOfVehiclesThatDoNotMeet) {
  const Situation situation({Traffic{.vehicle = {1}, .reachable_area_m = square(0.0, 0.0)},
                             Traffic{.vehicle = {2}, .reachable_area_m = square(5.0, 0.0)},
                             Traffic{.vehicle = {3}, .reachable_area_m = square(0.5, 0.0)}});
  MadeUpCosts costs(situation.graph, 1);
  static_cast<void>(kOptimalPriorities.search(situation.graph, {{1}, {2}, {3}}, std::ref(costs)));
  EXPECT_EQ(costs.num_tried(), 2U) << "1 before 3, and 3 before 1";
}

TEST(BestOrder, IsMostOftenBetterThanTheConstantOneOfTen) {
  std::size_t better = 0;
  constexpr std::uint64_t kSeeds = 50;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 10, 2.0);
    const Order start = situation.graph.component({1});
    MadeUpCosts costs(situation.graph, seed);
    const Order found = kBestOrder.search(situation.graph, start, std::ref(costs));
    if (is_better(costs(found), costs(start))) ++better;
  }
  EXPECT_GT(better, kSeeds / 2);
}

TEST(RandomPriorities, DifferFromStepToStep) {
  std::mt19937_64 random(1);
  Situation situation = drawn(random, 6);
  std::map<VehicleId, int> first;
  for (std::uint64_t step = 0; step < 600; ++step) {
    situation.traffic.front().step = {step};
    ++first[kRandomPriorities.assign(situation.get()).front()];
  }
  EXPECT_EQ(first.size(), 6U);
  for (const auto& [vehicle, times] : first) EXPECT_GT(times, 60) << int{vehicle.value};
}

TEST(Fca, LetsThoseFirstWhoseReferencesMeetMost) {
  const auto traffic = [](std::uint8_t vehicle, double x_m) {
    return Traffic{.vehicle = {vehicle},
                   .reachable_area_m = square(x_m, 0.0, 9.0),
                   .reference_areas_m = {square(x_m, 0.0)}};
  };
  // 3 meets 1 and 2, which do not meet each other; 4 meets nobody.
  const Situation situation({traffic(1, 0.0), traffic(2, 1.6), traffic(3, 0.8), traffic(4, 3.0)});
  EXPECT_THAT(kMostCollisionsFirst.assign(situation.get()),
              ElementsAre(VehicleId{3}, VehicleId{1}, VehicleId{2}, VehicleId{4}));
}

TEST(WaitingTime, LetsThoseFirstWhoHaveStoodLongest) {
  const auto traffic = [](std::uint8_t vehicle, std::uint32_t steps) {
    return Traffic{
        .vehicle = {vehicle}, .reachable_area_m = square(0.0, 0.0), .standing_steps = steps};
  };
  const Situation situation({traffic(1, 0), traffic(2, 7), traffic(3, 0), traffic(4, 9)});
  EXPECT_THAT(kWaitingTimePriorities.assign(situation.get()),
              ElementsAre(VehicleId{4}, VehicleId{2}, VehicleId{1}, VehicleId{3}));
}

TEST(Colouring, NeedsNoMoreLevelsThanOneMoreThanTheMostNeighbours) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 12);
    std::size_t most_neighbours = 0;
    for (const VehicleId one : situation.graph.vehicles()) {
      most_neighbours = std::max(most_neighbours, situation.graph.neighbours(one).size());
    }
    const PriorityRule rule{.strategy = &kColouringPriorities};
    for (const auto& [vehicle, level] :
         computation_levels(situation.graph, rule.assign(situation.get()))) {
      EXPECT_LE(level, most_neighbours) << int{vehicle.value};
    }
  }
}

// A path of vehicles in bad order needs as many levels as vehicles, and two colours.
TEST(Colouring, NeedsTwoLevelsOnAPath) {
  std::vector<Traffic> traffic;
  for (std::uint8_t id = 1; id <= 8; ++id) {
    traffic.push_back({.vehicle = {id}, .reachable_area_m = square(0.9 * id, 0.0)});
  }
  const Situation situation(std::move(traffic));
  const auto num_levels = [&](const PriorityStrategy& strategy) {
    const PriorityRule rule{.strategy = &strategy};
    std::set<std::uint32_t> levels;
    for (const auto& [vehicle, level] :
         computation_levels(situation.graph, rule.assign(situation.get()))) {
      levels.insert(level);
    }
    return levels.size();
  };
  EXPECT_EQ(num_levels(kConstantPriorities), 8U);
  EXPECT_EQ(num_levels(kColouringPriorities), 2U);
}

TEST(PriorityGroups, LeaveNoMoreLevelsThanAllowedAndCutNothingWithoutNeed) {
  std::size_t cut = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Situation situation = drawn(random, 1 + random_index(random, 12));
    const PriorityRule free{.strategy = &kRandomPriorities};
    const PriorityRule limited{.strategy = &kRandomPriorities,
                               .max_levels = 1 + random_index(random, 4)};
    const PriorityOrder order = limited.assign(situation.get());
    std::uint32_t most_free = 0;
    for (const auto& [vehicle, level] :
         computation_levels(situation.graph, free.assign(situation.get()))) {
      most_free = std::max(most_free, level + 1);
    }
    for (const auto& [vehicle, level] : computation_levels(situation.graph, order)) {
      EXPECT_LT(level, limited.max_levels);
    }
    const bool is_any_cut = std::ranges::any_of(situation.graph.vehicles(), [&](VehicleId one) {
      return std::ranges::any_of(situation.graph.neighbours(one), [&](VehicleId other) {
        return !order.are_in_one_group(one, other);
      });
    });
    EXPECT_EQ(is_any_cut, most_free > limited.max_levels);
    if (is_any_cut) ++cut;
  }
  EXPECT_GT(cut, test::num_seeds(200) / 4);
}

}  // namespace
}  // namespace hlc::coordination::priorities_test
