#include "planner/right_of_way/grant_order.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/num_seeds.hpp"

namespace hlc::right_of_way::grant_order_test {
namespace {

/// Few values, so that many are alike in some of them.
std::vector<Holder> drawn(std::mt19937_64& random) {
  std::vector<Holder> holders(8);
  for (std::size_t i = 0; i < holders.size(); ++i) {
    holders[i].vehicle = {static_cast<std::uint8_t>(i + 1)};
    holders[i].claim.ahead_m = 0.1 * static_cast<double>(random() % 3);
    holders[i].claim.waiting_steps = static_cast<std::uint32_t>(random() % 3);
  }
  return holders;
}

TEST(GrantOrders, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const GrantOrder* one : grant_orders()) {
    EXPECT_TRUE(names.insert(one->name).second) << one->name;
    EXPECT_EQ(grant_order(one->name), one);
  }
  EXPECT_EQ(grant_orders().front(), &kLongestWait);
  EXPECT_EQ(grant_order("none"), nullptr);
}

void expect_strict_weak_order(const GrantOrder& order, const std::vector<Holder>& holders) {
  const auto are_alike = [&](const Holder& a, const Holder& b) {
    return !order.is_before(a, b) && !order.is_before(b, a);
  };
  for (const Holder& a : holders) {
    EXPECT_FALSE(order.is_before(a, a));
    for (const Holder& b : holders) {
      EXPECT_FALSE(order.is_before(a, b) && order.is_before(b, a));
      for (const Holder& c : holders) {
        EXPECT_TRUE(!order.is_before(a, b) || !order.is_before(b, c) || order.is_before(a, c));
        EXPECT_TRUE(!are_alike(a, b) || !are_alike(b, c) || are_alike(a, c));
      }
    }
  }
}

TEST(GrantOrders, AreStrictWeakOrders) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(20); ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<Holder> holders = drawn(random);
    for (const GrantOrder* order : grant_orders()) {
      SCOPED_TRACE(std::string(order->name) + ", seed " + std::to_string(seed));
      expect_strict_weak_order(*order, holders);
    }
  }
}

TEST(GrantOrders, DifferInWhetherAWaitCounts) {
  const Holder waiting{.vehicle = {1}, .claim = {.ahead_m = 0.5, .waiting_steps = 7}};
  const Holder near{.vehicle = {2}, .claim = {.ahead_m = 0.1}};
  EXPECT_TRUE(kLongestWait.is_before(waiting, near));
  EXPECT_TRUE(kNearestEnd.is_before(near, waiting));
}

}  // namespace
}  // namespace hlc::right_of_way::grant_order_test
