#include "planner/coordination/commit.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "planner/geometry/footprint.hpp"

namespace hlc::coordination {
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

TEST(Commit, PlansThatMeetAtTheSameTimeAreNotFree) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), standing_at(3.0, {10}), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), standing_at(6.0, {10}), {10}, 8));
}

TEST(Commit, TheSamePlaceAtAnotherTimeIsFree) {
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), driving_from(2.0, {10}), {10}, 8));
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), driving_from(2.0, {12}), {12}, 8));
}

TEST(Commit, WhatLiesBeforeTheFirstStepDoesNotCount) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), standing_at(0.2, {10}), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), standing_at(0.2, {10}), {12}, 8));
}

TEST(Commit, AnAreaThatDoesNotMoveIsMetAtAnyTime) {
  EXPECT_FALSE(are_free(driving_from(0.0, {10}), square_at(4.3), {10}, 8));
  EXPECT_TRUE(are_free(driving_from(0.0, {10}), square_at(5.5), {10}, 8));
}

/// Verdict about driving_from(0.0, {10}), which ends on [3.5, 4.5].
CommitVerdict verdict(std::initializer_list<CoupledAreas> coupled) {
  const OccupiedAreas planned = driving_from(0.0, {10});
  return commit_strictly({.planned = &planned,
                          .coupled = {coupled.begin(), coupled.size()},
                          .from = {10},
                          .steps = 8});
}

const ConvexPolygon kReachNear = square_at(3.0);
const ConvexPolygon kReachFar = square_at(9.0);
const OccupiedAreas kInTheWay = standing_at(3.0, {10});
const OccupiedAreas kAside = standing_at(6.0, {10});

TEST(CommitStrictly, WithoutCoupledVehiclesAPlanComesIntoForce) {
  EXPECT_EQ(verdict({}), CommitVerdict::kInForce);
}

TEST(CommitStrictly, APredictionInTheWayKeepsThePlanBack) {
  EXPECT_EQ(verdict({{&kReachNear, &kAside}}), CommitVerdict::kInForce);
  EXPECT_EQ(verdict({{&kReachNear, &kInTheWay}}), CommitVerdict::kConflict);
  EXPECT_EQ(verdict({{&kReachNear, &kAside}, {&kReachNear, &kInTheWay}}), CommitVerdict::kConflict);
}

TEST(CommitStrictly, WhoWasNotReceivedMayBeAnywhereWithinItsReach) {
  EXPECT_EQ(verdict({{&kReachNear, nullptr}}), CommitVerdict::kNotReceived);
  EXPECT_EQ(verdict({{&kReachFar, nullptr}}), CommitVerdict::kInForce);
  EXPECT_EQ(verdict({{&kReachFar, nullptr}, {&kReachNear, nullptr}}), CommitVerdict::kNotReceived);
}

TEST(CommitStrictly, OnlyTheHorizonIsLookedAtAndAfterItTheStandingFootprint) {
  const OccupiedAreas leaves{
      .first = {10}, .areas_m = {square_at(3.5), square_at(8.0)}, .final_area_m = square_at(8.0)};
  const std::vector<CoupledAreas> coupled{{&kReachNear, &leaves}};
  const OccupiedAreas stands = standing_at(3.5, {10});
  CommitInputs inputs{.planned = &stands, .coupled = coupled, .from = {10}, .steps = 1};
  EXPECT_EQ(commit_strictly(inputs), CommitVerdict::kConflict);
  inputs.from = {11};
  inputs.steps = 8;
  EXPECT_EQ(commit_strictly(inputs), CommitVerdict::kInForce);
}

TEST(CommitByVotes, TakesEveryVote) {
  const Outcome agrees{};
  const Outcome falls_back{.wants_fallback = true};
  const auto verdict_of = [](std::vector<const Outcome*> votes) {
    return commit_by_votes({.votes = votes});
  };
  EXPECT_EQ(verdict_of({}), CommitVerdict::kInForce);
  EXPECT_EQ(verdict_of({&agrees, &agrees}), CommitVerdict::kInForce);
  EXPECT_EQ(verdict_of({&agrees, &falls_back}), CommitVerdict::kFallback);
  EXPECT_EQ(verdict_of({nullptr, &agrees}), CommitVerdict::kFallback) << "silence is no consent";
}

}  // namespace
}  // namespace hlc::coordination
