#include "planner/maneuver_design/dominance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hlc::maneuver_design {
namespace {

using testing::Message;

std::vector<Objectives> random_points(std::size_t count, Eigen::Index size, std::mt19937& random) {
  std::uniform_int_distribution<int> tenth(0, 10);  // equal values happen
  std::vector<Objectives> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(
        Objectives::NullaryExpr(size, [&](Eigen::Index) { return 0.1 * tenth(random); }));
  }
  return points;
}

Objectives of(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

TEST(Dominance, NeedsNoWorseEverywhereAndBetterSomewhere) {
  EXPECT_TRUE(dominates(of({1.0, 2.0}), of({1.0, 3.0})));
  EXPECT_FALSE(dominates(of({1.0, 2.0}), of({1.0, 2.0})));
  EXPECT_FALSE(dominates(of({0.0, 3.0}), of({1.0, 2.0})));
  EXPECT_FALSE(dominates(of({1.0, 2.0}), of({1.0, 2.05}), of({0.1, 0.1})));
  EXPECT_TRUE(dominates(of({1.05, 1.0}), of({1.0, 2.0}), of({0.1, 0.1})));
}

TEST(Dominance, IsAStrictPartialOrder) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  for (int run = 0; run < 2000; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    const auto p = random_points(3, 3, random);
    EXPECT_FALSE(dominates(p[0], p[0]));
    EXPECT_FALSE(dominates(p[0], p[1]) && dominates(p[1], p[0]));
    if (dominates(p[0], p[1]) && dominates(p[1], p[2])) {
      EXPECT_TRUE(dominates(p[0], p[2]));
    }
  }
}

TEST(Dominance, WhatTheFilterKeepsIsUndominatedAndDominatesTheRestInAnyOrder) {
  constexpr unsigned kSeed = 12;
  std::mt19937 random(kSeed);
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    auto points = random_points(25, 2 + run % 3, random);
    const std::vector<std::size_t> kept = non_dominated(points);
    ASSERT_FALSE(kept.empty());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_kept = std::find(kept.begin(), kept.end(), i) != kept.end();
      const bool is_below_one = std::any_of(
          kept.begin(), kept.end(), [&](std::size_t k) { return dominates(points[k], points[i]); });
      EXPECT_NE(is_kept, is_below_one);
    }
    std::vector<double> before;
    for (const std::size_t i : kept) before.push_back(points[i].sum());
    std::shuffle(points.begin(), points.end(), random);
    std::vector<double> after;
    for (const std::size_t i : non_dominated(points)) after.push_back(points[i].sum());
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    EXPECT_EQ(before, after);
  }
}

TEST(Hypervolume, OfKnownShapes) {
  const Objectives two = of({1.0, 1.0});
  EXPECT_DOUBLE_EQ(hypervolume({of({0.25, 0.5})}, two), 0.375);
  EXPECT_DOUBLE_EQ(hypervolume({of({0.0, 0.5}), of({0.5, 0.0})}, two), 0.75);
  EXPECT_EQ(hypervolume({of({2.0, 0.0})}, two), 0.0);
  EXPECT_EQ(hypervolume({}, two), 0.0);
  const Objectives three = of({1.0, 1.0, 1.0});
  EXPECT_DOUBLE_EQ(hypervolume({of({0.5, 0.5, 0.5})}, three), 0.125);
  // Three slabs that share pieces: inclusion and exclusion.
  EXPECT_DOUBLE_EQ(
      hypervolume({of({0.0, 0.5, 0.5}), of({0.5, 0.0, 0.5}), of({0.5, 0.5, 0.0})}, three),
      3 * 0.25 - 3 * 0.125 + 0.125);
}

TEST(Hypervolume, IsTheShareOfRandomPointsThatAreDominatedUpToFourObjectives) {
  constexpr unsigned kSeed = 13;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (Eigen::Index size = 1; size <= 4; ++size) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", " << size << " objectives");
    const auto points = random_points(6, size, random);
    constexpr int kSamples = 40000;
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Objectives sample =
          Objectives::NullaryExpr(size, [&](Eigen::Index) { return unit(random); });
      inside += std::any_of(points.begin(), points.end(), [&](const Objectives& p) {
        return (p.array() <= sample.array()).all();
      });
    }
    EXPECT_NEAR(hypervolume(points, Objectives::Ones(size)), inside / double{kSamples}, 0.01);
  }
}

TEST(KneePoint, IsTheOneFarthestFromTheLineBetweenTheEnds) {
  // On the circle (1 - x)^2 + (1 - y)^2 = 1, stretched: the middle.
  std::vector<Objectives> points;
  for (int i = 0; i <= 10; ++i) {
    const double angle = 0.05 * 3.14159265358979 * i;
    points.push_back(of({1000.0 * (1.0 - std::sin(angle)), 1e-3 * (1.0 - std::cos(angle)) - 7.0}));
  }
  EXPECT_EQ(knee_point(points), 5U);
  EXPECT_EQ(knee_point({of({1.0, 1.0})}), 0U);
}

}  // namespace
}  // namespace hlc::maneuver_design
