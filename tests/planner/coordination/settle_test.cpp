#include "planner/coordination/settle.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hlc
