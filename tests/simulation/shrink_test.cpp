#include "vehicle_sim/closed_loop/shrink.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace hlc::closed_loop {
namespace {

std::vector<int> numbers(int count) {
  std::vector<int> items(static_cast<std::size_t>(count));
  std::iota(items.begin(), items.end(), 0);
  return items;
}

bool holds(const std::vector<int>& items, int item) {
  return std::ranges::find(items, item) != items.end();
}

TEST(Shrink, KeepsWhatIsNeededAndNothingElse) {
  for (int count = 2; count < 20; ++count) {
    const auto fails = [&](const std::vector<int>& items) {
      return holds(items, 1) && holds(items, count - 1);
    };
    const std::vector<int> expected = count == 2 ? std::vector{1} : std::vector{1, count - 1};
    EXPECT_EQ(shrunk<int>(numbers(count), fails), expected);
  }
}

TEST(Shrink, WhatFailsByItselfNeedsNothing) {
  EXPECT_TRUE(shrunk<int>(numbers(9), [](const auto&) { return true; }).empty());
}

TEST(Shrink, LeavesOutWhatIsNeededOnlyBesideSomethingElse) {
  // 3 alone fails; with 0 there, 5 is needed, too.
  const auto fails = [](const std::vector<int>& items) {
    return holds(items, 3) && (!holds(items, 0) || holds(items, 5));
  };
  EXPECT_EQ(shrunk<int>(numbers(8), fails), std::vector{3});
}

TEST(Shrink, OfNothingNothingIsLeft) {
  EXPECT_TRUE(shrunk<int>({}, [](const auto&) { return true; }).empty());
}

}  // namespace
}  // namespace hlc::closed_loop
