#include "planner/coordination/coupling_rule.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "planner/geometry/footprint.hpp"
#include "tests/planner/coordination/coupling_graph.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::coordination::coupling_rule_test {
namespace {

std::vector<Traffic> drawn(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(0.0, 4.0);
  std::vector<Traffic> traffic(6);
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    traffic[i].vehicle = {static_cast<std::uint8_t>(i + 1)};
    traffic[i].reachable_area_m =
        footprint_area({1.0, 1.0}, {place(random), place(random), place(random)});
  }
  return traffic;
}

TEST(CouplingRules, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const CouplingRule* one : coupling_rules()) {
    EXPECT_TRUE(names.insert(one->name).second) << one->name;
    EXPECT_EQ(coupling_rule(one->name), one);
  }
  EXPECT_EQ(coupling_rules().front(), &kReachableAreas);
  EXPECT_EQ(coupling_rule("none"), nullptr);
}

bool of_larger_id(const Traffic& a, const Traffic& b) { return a.vehicle < b.vehicle; }
bool never(const Traffic& /*a*/, const Traffic& /*b*/) { return false; }

// What safety needs of each, also of one whose function does not look at the areas, or treats the
// two differently.
TEST(CouplingRules, CoupleBothWaysAllThatMayMeet) {
  const CouplingRule one_way{.name = "one way", .couples_also = &of_larger_id};
  const CouplingRule none{.name = "none", .couples_also = &never};
  std::vector<const CouplingRule*> rules{&one_way, &none};
  rules.insert(rules.end(), coupling_rules().begin(), coupling_rules().end());
  std::size_t coupled = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(50); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const std::vector<Traffic> traffic = drawn(random);
    for (const CouplingRule* rule : rules) {
      for (const Traffic& a : traffic) {
        for (const Traffic& b : traffic) {
          EXPECT_EQ(are_coupled(a, b, *rule), are_coupled(b, a, *rule)) << rule->name;
          if (!intersects(a.reachable_area_m, b.reachable_area_m)) continue;
          EXPECT_TRUE(are_coupled(a, b, *rule)) << rule->name;
          ++coupled;
        }
      }
    }
  }
  EXPECT_GT(coupled, 0U);
}

TEST(CouplingRules, AllCouplesThoseThatCannotMeet) {
  std::vector<Traffic> traffic(2);
  traffic[0].vehicle = {1};
  traffic[0].reachable_area_m = footprint_area({1.0, 1.0}, {0.0, 0.0, 0.0});
  traffic[1].vehicle = {2};
  traffic[1].reachable_area_m = footprint_area({1.0, 1.0}, {9.0, 0.0, 0.0});
  EXPECT_FALSE(graph_of(traffic).are_coupled({1}, {2}));
  EXPECT_TRUE(CouplingGraph({&traffic[0], &traffic[1]}, kAllVehicles).are_coupled({1}, {2}));
}

}  // namespace
}  // namespace hlc::coordination::coupling_rule_test
