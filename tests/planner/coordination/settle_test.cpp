#include "planner/coordination/settle.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "planner/geometry/footprint.hpp"

namespace hlc {
namespace {

ConvexPolygon square_at(double x) { return footprint_area({1.0, 1.0}, {x, 0.0, 0.0}); }

OccupiedAreas standing_at(double x, StepIndex from) {
  return {.first = from, .areas_m = {}, .final_area_m = square_at(x)};
}

/// Drives one unit per step from x, for four steps.
OccupiedAreas driving_from(double x, StepIndex from) {
  OccupiedAreas areas{.first = from, .areas_m = {}, .final_area_m = square_at(x + 4.0)};
  for (int i = 0; i < 4; ++i) areas.areas_m.push_back(square_at(x + i + 0.5));
  return areas;
}

TEST(Settle, PlansThatMeetAtTheSameTimeAreNotFree) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), standing_at(3.0, {10}), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), standing_at(6.0, {10}), {10}, 8));
}

TEST(Settle, TheSamePlaceAtAnotherTimeIsFree) {
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), driving_from(2.0, {10}), {10}, 8));
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), driving_from(2.0, {12}), {12}, 8));
}

TEST(Settle, WhatLiesBeforeTheFirstStepDoesNotCount) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), standing_at(0.2, {10}), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), standing_at(0.2, {10}), {12}, 8));
}

TEST(Settle, AnAreaThatDoesNotMoveIsMetAtAnyTime) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), square_at(4.3), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), square_at(5.5), {10}, 8));
}

/// Verdict about driving_from(0.0, {10}), which ends on [3.5, 4.5].
SettleVerdict verdict(std::initializer_list<HeardCoupled> coupled) {
  return settle_strictly(driving_from(0.0, {10}), {coupled.begin(), coupled.size()}, {10}, 8);
}

const ConvexPolygon kReachNear = square_at(3.0);
const ConvexPolygon kReachFar = square_at(9.0);
const OccupiedAreas kInTheWay = standing_at(3.0, {10});
const OccupiedAreas kAside = standing_at(6.0, {10});

TEST(SettleStrictly, WithoutCoupledVehiclesAPlanComesIntoForce) {
  EXPECT_EQ(verdict({}), SettleVerdict::kInForce);
}

TEST(SettleStrictly, APredictionInTheWayKeepsThePlanBack) {
  EXPECT_EQ(verdict({{&kReachNear, &kAside}}), SettleVerdict::kInForce);
  EXPECT_EQ(verdict({{&kReachNear, &kInTheWay}}), SettleVerdict::kConflict);
  EXPECT_EQ(verdict({{&kReachNear, &kAside}, {&kReachNear, &kInTheWay}}), SettleVerdict::kConflict);
}

TEST(SettleStrictly, WhoWasNotHeardMayBeAnywhereWithinItsReach) {
  EXPECT_EQ(verdict({{&kReachNear, nullptr}}), SettleVerdict::kUnheard);
  EXPECT_EQ(verdict({{&kReachFar, nullptr}}), SettleVerdict::kInForce);
  EXPECT_EQ(verdict({{&kReachFar, nullptr}, {&kReachNear, nullptr}}), SettleVerdict::kUnheard);
}

TEST(SettleStrictly, OnlyTheHorizonIsLookedAtAndAfterItTheStandingFootprint) {
  const OccupiedAreas leaves{
      .first = {10}, .areas_m = {square_at(3.5), square_at(8.0)}, .final_area_m = square_at(8.0)};
  const std::vector<HeardCoupled> coupled{{&kReachNear, &leaves}};
  const OccupiedAreas stands = standing_at(3.5, {10});
  EXPECT_EQ(settle_strictly(stands, coupled, {10}, 1), SettleVerdict::kConflict);
  EXPECT_EQ(settle_strictly(stands, coupled, {11}, 8), SettleVerdict::kInForce);
}

TEST(SettleByVotes, TakesEveryVote) {
  const Outcome agrees{};
  const Outcome falls_back{.wants_fallback = true};
  const auto verdict_of = [](std::vector<const Outcome*> votes) { return settle_by_votes(votes); };
  EXPECT_EQ(verdict_of({}), SettleVerdict::kInForce);
  EXPECT_EQ(verdict_of({&agrees, &agrees}), SettleVerdict::kInForce);
  EXPECT_EQ(verdict_of({&agrees, &falls_back}), SettleVerdict::kFallback);
  EXPECT_EQ(verdict_of({nullptr, &agrees}), SettleVerdict::kFallback) << "silence is no consent";
}

}  // namespace
}  // namespace hlc
